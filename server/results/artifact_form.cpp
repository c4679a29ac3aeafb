#include "server/results/artifact_form.hpp"

#include <algorithm>

#include "core/program/program_demands.hpp"
#include "server/results/programs.hpp"

namespace sculpt::server {
namespace {

using Format = ArtifactKind::Format;
constexpr std::array kinds{
    ArtifactKind{"trajectory",
                 {Format{"ndjson"}, Format{"csv", Origin::first_form}, Format{"binary", Origin::first_form}},
                 true},
    ArtifactKind{"timeline", {Format{"tokens"}, Format{"gzip", Origin::first_form}}, true},
    ArtifactKind{"voxels", {Format{"binvox"}}},
    ArtifactKind{"stock", {Format{"binvox"}, Format{"zip", Origin::job}}},
    ArtifactKind{"surface", {Format{"ply", Origin::job}}},
    ArtifactKind{"residue", {Format{"ndjson"}, Format{"gzip", Origin::first_form}}},
    ArtifactKind{"report", {Format{"json"}}},
    ArtifactKind{"program", {Format{"zip", Origin::program}}}};

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : ", ") + word;
  return out;
}

const ArtifactKind& find_kind(const std::string& artifact) {
  std::vector<std::string> names;
  for (const ArtifactKind& kind : kinds) {
    if (artifact == kind.artifact) return kind;
    names.emplace_back(kind.artifact);
  }
  throw proto::ProtocolError("params_invalid", "there is no artifact '" + artifact + "': there are " + joined(names),
                             "/params/artifact");
}

// The own name of the form, where it has another one than files end in.
std::string file_name(const std::string& artifact, const std::string& format) {
  return artifact + "." + (format == "binary" ? "sct" : format == "gzip" ? "gz" : format);
}

}  // namespace

std::vector<std::string> ArtifactKind::format_names() const {
  std::vector<std::string> names;
  for (const Format& format : formats)
    if (format.name != nullptr) names.emplace_back(format.name);
  return names;
}

std::span<const ArtifactKind> artifact_kinds() {
  return kinds;
}

ArtifactForm form_of(const ArtifactKind& kind, const std::string& format) {
  const auto found = std::ranges::find_if(kind.formats, [&](const Format& each) {
    return each.name != nullptr && (format.empty() || format == each.name);
  });
  ArtifactForm form{&kind, found->name, file_name(kind.artifact, found->name), found->origin, kind.artifact};
  if (form.in_child()) form.source = "trajectory";
  return form;
}

ArtifactForm find_form(const proto::ArtifactReadParams& wanted) {
  const ArtifactKind& kind = find_kind(wanted.artifact);
  const std::vector<std::string> names = kind.format_names();
  if (!wanted.format.empty() && std::ranges::find(names, wanted.format) == names.end()) {
    throw proto::ProtocolError(
        "params_invalid",
        "the artifact " + wanted.artifact + " has no format '" + wanted.format + "': it has " + joined(names),
        "/params/format");
  }
  ArtifactForm form = form_of(kind, wanted.format);
  if (wanted.program) {
    parse_dialect(wanted.program->dialect);
    check_program_name(wanted.program->name);
    form.file = program_file(*wanted.program);
  }
  return form;
}

std::string download_name(const proto::ArtifactReadParams& wanted) {
  const ArtifactForm form = find_form(wanted);
  return wanted.program ? file_name(wanted.program->name, form.format) : form.file;
}

}  // namespace sculpt::server
