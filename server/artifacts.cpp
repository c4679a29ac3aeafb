#include "server/artifacts.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <optional>

#include "server/crash_point.hpp"
#include "server/data_folder.hpp"

namespace sculpt {
namespace {

namespace fs = std::filesystem;

struct Kind {
  const char* artifact;
  std::array<const char*, 3> formats;  // the first is the artifact's own; nullptr: none
};

constexpr std::array kinds{Kind{"trajectory", {"ndjson", "csv", "binary"}},
                           Kind{"voxels", {"binvox", nullptr, nullptr}}, Kind{"residue", {"ndjson", nullptr, nullptr}},
                           Kind{"report", {"json", nullptr, nullptr}}};

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : ", ") + word;
  return out;
}

const Kind& find_kind(const std::string& artifact) {
  std::vector<std::string> names;
  for (const Kind& kind : kinds) {
    if (artifact == kind.artifact) return kind;
    names.emplace_back(kind.artifact);
  }
  throw ProtocolError("params_invalid", "there is no artifact '" + artifact + "': there are " + joined(names),
                      "/params/artifact");
}

std::vector<std::string> formats(const Kind& kind) {
  std::vector<std::string> names;
  for (const char* format : kind.formats) {
    if (format != nullptr) names.emplace_back(format);
  }
  return names;
}

std::string choose_format(const ArtifactReadParams& wanted) {
  const std::vector<std::string> names = formats(find_kind(wanted.artifact));
  if (wanted.format.empty()) return names.front();
  if (std::ranges::find(names, wanted.format) == names.end()) {
    throw ProtocolError(
        "params_invalid",
        "the artifact " + wanted.artifact + " has no format '" + wanted.format + "': it has " + joined(names),
        "/params/format");
  }
  return wanted.format;
}

std::string file_name(const std::string& artifact, const std::string& format) {
  return artifact + "." + (format == "binary" ? "sct" : format);
}

std::optional<StoredArtifact> find_stored(const std::vector<StoredArtifact>& all, const std::string& artifact) {
  const auto found = std::ranges::find(all, artifact, &StoredArtifact::artifact);
  return found == all.end() ? std::nullopt : std::optional(*found);
}

[[noreturn]] void refuse_missing(const JobRecord& job, const std::string& what) {
  const std::string why = job.error_sentence.empty() ? "" : " (" + job.error_sentence + ")";
  throw ProtocolError("wrong_state", "job " + job.id + " is " + name(job.state) + why + " and has no " + what);
}

std::uint64_t size_now(const fs::path& file) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  return error ? 0 : size;
}

std::string read_part(const fs::path& file, std::uint64_t offset, std::uint64_t bytes) {
  std::string part(bytes, '\0');
  if (bytes == 0) return part;
  std::ifstream in(file, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(offset));
  in.read(part.data(), static_cast<std::streamsize>(bytes));
  if (static_cast<std::uint64_t>(in.gcount()) != bytes) throw StorageError("cannot read '" + file.string() + "'");
  return part;
}

}  // namespace

void Artifacts::discard_leftovers(const std::string& job) const {
  const std::optional<JobRecord> record = store_.find(job);
  if (record && (!is_final(record->state) || !store_.artifacts(job).empty())) return;
  std::error_code ignored;
  fs::remove_all(job_folder(job), ignored);
}

Json Artifacts::list(const JobRecord& job) const {
  const std::vector<StoredArtifact> stored = store_.artifacts(job.id);
  Json list = Json::array();
  for (const Kind& kind : kinds) {
    Json entry{{"artifact", kind.artifact}, {"formats", formats(kind)}};
    if (const std::optional<StoredArtifact> artifact = find_stored(stored, kind.artifact)) {
      entry.update({{"size", artifact->size}, {"final", true}, {"sha256", artifact->sha256}});
    } else {
      const bool grows = entry["artifact"] == "trajectory";
      entry.update({{"size", grows ? size_now(trajectory(job.id)) : 0}, {"final", false}});
    }
    list.push_back(std::move(entry));
  }
  return list;
}

ArtifactChunk Artifacts::read(const ArtifactReadParams& wanted) const {
  ArtifactChunk chunk;
  chunk.format = choose_format(wanted);
  const JobRecord job = find_job(store_, wanted.job);
  const fs::path file = job_folder(job.id) / file_name(wanted.artifact, chunk.format);
  chunk.final = find_stored(store_.artifacts(job.id), wanted.artifact).has_value();
  const bool grows = wanted.artifact == "trajectory" && chunk.format == "ndjson" && !is_final(job.state);
  if (!chunk.final && !grows) refuse_missing(job, "final " + wanted.artifact);
  chunk.size = size_now(file);
  if (chunk.final && wanted.offset > chunk.size) {
    throw ProtocolError("params_invalid",
                        "offset " + std::to_string(wanted.offset) + " is beyond the artifact's " +
                            std::to_string(chunk.size) + " bytes",
                        "/params/offset");
  }
  const std::uint64_t left = chunk.size > wanted.offset ? chunk.size - wanted.offset : 0;
  chunk.bytes = read_part(file, wanted.offset, std::min<std::uint64_t>(left, wanted.bytes));
  return chunk;
}

bool Artifacts::needs_export(const ArtifactReadParams& wanted) const {
  const std::string format = choose_format(wanted);
  if (wanted.artifact != "trajectory" || format == "ndjson") return false;
  return !fs::exists(job_folder(wanted.job) / file_name(wanted.artifact, format));
}

void Artifacts::make_export(const ArtifactReadParams& wanted) const {
  if (!needs_export(wanted)) return;
  const JobRecord job = find_job(store_, wanted.job);
  if (!find_stored(store_.artifacts(job.id), wanted.artifact)) {
    refuse_missing(job, "final trajectory to make " + wanted.format + " from; ndjson can be read while it grows");
  }
  const fs::path file = job_folder(job.id) / file_name(wanted.artifact, wanted.format);
  const fs::path draft = file.string() + ".draft";
  std::ifstream in(trajectory(job.id), std::ios::binary);
  std::ofstream out(draft, std::ios::binary | std::ios::trunc);
  (wanted.format == "csv" ? planner_.to_csv : planner_.to_binary)(in, out);
  out.close();
  if (!out) throw StorageError("cannot write '" + draft.string() + "': check the free space");
  sync_to_disk(draft);
  crash_point(CrashPoint::export_synced);
  fs::rename(draft, file);
}

std::string Artifacts::read_whole(const JobRecord& job, const std::string& artifact) const {
  const std::optional<StoredArtifact> stored = find_stored(store_.artifacts(job.id), artifact);
  if (!stored) refuse_missing(job, artifact);
  return read_part(job_folder(job.id) / file_name(artifact, stored->format), 0, stored->size);
}

}  // namespace sculpt
