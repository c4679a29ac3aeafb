#include "server/results/artifact_form.hpp"

#include <algorithm>

#include "core/program/program_demands.hpp"
#include "server/results/programs.hpp"

namespace sculpt::server {
namespace {

constexpr std::array kinds{ArtifactKind{"trajectory", {"ndjson", "csv", "binary"}, true},
                           ArtifactKind{"timeline", {"tokens", "gzip", nullptr}, true},
                           ArtifactKind{"voxels", {"binvox", nullptr, nullptr}},
                           ArtifactKind{"stock", {"binvox", nullptr, nullptr}},
                           ArtifactKind{"residue", {"ndjson", nullptr, nullptr}},
                           ArtifactKind{"report", {"json", nullptr, nullptr}},
                           ArtifactKind{"program", {"zip", nullptr, nullptr}, false, "trajectory"}};

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
  for (const char* format : formats) {
    if (format != nullptr) names.emplace_back(format);
  }
  return names;
}

std::span<const ArtifactKind> artifact_kinds() {
  return kinds;
}

ArtifactForm form_of(const ArtifactKind& kind, const std::string& format) {
  const std::string own = kind.formats.front(), wanted = format.empty() ? own : format;
  const bool is_own = wanted == own && kind.made_of == nullptr;
  return {&kind, wanted, file_name(kind.artifact, wanted), is_own,
          kind.made_of == nullptr ? kind.artifact : kind.made_of};
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
