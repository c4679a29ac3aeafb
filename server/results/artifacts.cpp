#include "server/results/artifacts.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>

#include "server/base/crash_point.hpp"
#include "server/files/durable.hpp"
#include "server/files/gzip.hpp"
#include "server/files/job_folder.hpp"
#include "server/files/orphans.hpp"
#include "server/results/exported_file.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

struct Kind {
  const char* artifact;
  std::array<const char*, 3> formats;  // the first is the artifact's own; nullptr: none
  bool grows = false;                  // its own form, while the job runs
};

constexpr std::array kinds{
    Kind{"trajectory", {"ndjson", "csv", "binary"}, true}, Kind{"timeline", {"tokens", "gzip", nullptr}, true},
    Kind{"voxels", {"binvox", nullptr, nullptr}},          Kind{"stock", {"binvox", nullptr, nullptr}},
    Kind{"residue", {"ndjson", nullptr, nullptr}},         Kind{"report", {"json", nullptr, nullptr}}};

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
  throw proto::ProtocolError("params_invalid", "there is no artifact '" + artifact + "': there are " + joined(names),
                             "/params/artifact");
}

std::vector<std::string> formats(const Kind& kind) {
  std::vector<std::string> names;
  for (const char* format : kind.formats) {
    if (format != nullptr) names.emplace_back(format);
  }
  return names;
}

std::string choose_format(const proto::ArtifactReadParams& wanted) {
  const std::vector<std::string> names = formats(find_kind(wanted.artifact));
  if (wanted.format.empty()) return names.front();
  if (std::ranges::find(names, wanted.format) == names.end()) {
    throw proto::ProtocolError(
        "params_invalid",
        "the artifact " + wanted.artifact + " has no format '" + wanted.format + "': it has " + joined(names),
        "/params/format");
  }
  return wanted.format;
}

bool is_own(const Kind& kind, const std::string& format) {
  return format == kind.formats.front();
}

// The own name of the form, where it has another one than files end in.
std::string file_name(const std::string& artifact, const std::string& format) {
  return artifact + "." + (format == "binary" ? "sct" : format == "gzip" ? "gz" : format);
}

bool is_export(const std::string& artifact, const std::string& file) {
  const Kind& kind = find_kind(artifact);
  return file != file_name(artifact, kind.formats.front());
}

using Rewrite = std::function<void(std::istream&, std::ostream&)>;

// How an artifact's own form becomes another.
Rewrite rewrite_to(const std::string& format, const Planner& planner) {
  if (format == "gzip") return write_gzip;
  return format == "csv" ? planner.to_csv : planner.to_binary;
}

// Those that were made of a final artifact, with their seals.
Json list_exports(const fs::path& folder, const std::string& job, const Kind& kind) {
  Json made = Json::array();
  for (const std::string& format : formats(kind)) {
    const std::optional<FileSeal> seal = read_seal(folder, job, file_name(kind.artifact, format));
    if (seal) made.push_back({{"format", format}, {"size", seal->size}, {"sha256", seal->sha256}});
  }
  return made;
}

std::optional<StoredArtifact> find_stored(const std::vector<StoredArtifact>& all, const std::string& artifact) {
  const auto found = std::ranges::find(all, artifact, &StoredArtifact::artifact);
  return found == all.end() ? std::nullopt : std::optional(*found);
}

[[noreturn]] void refuse_missing(const JobRecord& job, const std::string& what) {
  const std::string why = job.error_sentence.empty() ? "" : " (" + job.error_sentence + ")";
  throw proto::ProtocolError("wrong_state", "job " + job.id + " is " + name(job.state) + why + " and has no " + what);
}

std::uint64_t size_now(const std::optional<StoredFile>& file) {
  return file ? file->size() : 0;
}

bool continues(const WholeRead& so_far, const proto::ArtifactReadParams& wanted, const std::string& format) {
  return so_far.job == wanted.job && so_far.artifact == wanted.artifact && so_far.format == format &&
         so_far.next == wanted.offset;
}

}  // namespace

void Artifacts::discard_leftovers(const std::string& job) const {
  const std::optional<JobRecord> record = store_.find(job);
  if (record && !is_final(record->state)) return;
  if (record && !store_.artifacts(job).empty()) return files_.remove(job, record->folder);
  std::error_code ignored;
  if (!record && !store_.was_removed(job)) {
    if (fs::exists(fs::symlink_status(folder() / job, ignored))) put_aside(folder(), job);
    return;
  }
  files_.remove(job);
}

// What a run wrote; the other forms are made here from it.
std::optional<StoredFile> Artifacts::open(const JobRecord& job, const std::string& artifact,
                                          const std::string& format) const {
  const std::string name = file_name(artifact, format);
  return is_export(artifact, name) ? StoredFile::open(folder(), job.folder, name) : files_.open(job.folder, name);
}

Json Artifacts::list(const JobRecord& job) const {
  const std::vector<StoredArtifact> stored = store_.artifacts(job.id);
  Json list = Json::array();
  for (const Kind& kind : kinds) {
    Json entry{{"artifact", kind.artifact}, {"formats", formats(kind)}};
    if (const std::optional<StoredArtifact> artifact = find_stored(stored, kind.artifact)) {
      entry.update({{"size", artifact->size}, {"final", true}, {"sha256", artifact->sha256}});
      if (Json made = list_exports(folder(), job.folder, kind); !made.empty()) entry["made"] = std::move(made);
    } else {
      const std::string own = file_name(kind.artifact, kind.formats.front());
      entry.update({{"size", kind.grows ? size_now(files_.open(job.folder, own)) : 0}, {"final", false}});
    }
    list.push_back(std::move(entry));
  }
  return list;
}

std::optional<FileSeal> Artifacts::seal_of(const JobRecord& job, const std::string& artifact,
                                           const std::string& format) const {
  const std::optional<StoredArtifact> stored = find_stored(store_.artifacts(job.id), artifact);
  if (!stored) return std::nullopt;
  if (format == stored->format) return FileSeal{stored->size, stored->sha256};
  return read_seal(folder(), job.folder, file_name(artifact, format));
}

ArtifactChunk Artifacts::read(const proto::ArtifactReadParams& wanted, WholeRead& so_far) const {
  ArtifactChunk chunk;
  chunk.format = choose_format(wanted);
  const JobRecord job = find_job(store_, wanted.job);
  const std::optional<FileSeal> seal = seal_of(job, wanted.artifact, chunk.format);
  chunk.final = seal.has_value();
  const Kind& kind = find_kind(wanted.artifact);
  const bool grows = kind.grows && is_own(kind, chunk.format) && !is_final(job.state);
  if (!chunk.final && !grows) refuse_missing(job, "final " + wanted.artifact);
  const std::string name = file_name(wanted.artifact, chunk.format);
  const std::optional<StoredFile> file = open(job, wanted.artifact, chunk.format);
  if (const std::string fault = seal ? fault_of_size(file, *seal) : ""; !fault.empty())
    refuse_damaged(job, wanted.artifact, name, fault);
  chunk.size = size_now(file);
  if (chunk.final && wanted.offset > chunk.size) {
    throw proto::ProtocolError("params_invalid",
                               "offset " + std::to_string(wanted.offset) + " is beyond the artifact's " +
                                   std::to_string(chunk.size) + " bytes",
                               "/params/offset");
  }
  const std::uint64_t left = chunk.size > wanted.offset ? chunk.size - wanted.offset : 0;
  if (file) chunk.bytes = file->read(wanted.offset, std::min<std::uint64_t>(left, wanted.bytes));
  follow(job, wanted, chunk, seal.value_or(FileSeal{}), so_far);
  return chunk;
}

// A growing trajectory is followed too: it may be final at its last piece.
void Artifacts::follow(const JobRecord& job, const proto::ArtifactReadParams& wanted, const ArtifactChunk& chunk,
                       const FileSeal& seal, WholeRead& so_far) const {
  if (wanted.offset == 0) so_far = {wanted.job, wanted.artifact, chunk.format, 0, {}};
  if (!continues(so_far, wanted, chunk.format)) return;
  so_far.hash.add(chunk.bytes);
  so_far.next += chunk.bytes.size();
  if (!chunk.final || so_far.next < chunk.size || so_far.hash.hex() == seal.sha256) return;
  const std::string name = file_name(wanted.artifact, chunk.format);
  const std::string fault = fault_of(open(job, wanted.artifact, chunk.format), seal);
  if (!fault.empty()) refuse_damaged(job, wanted.artifact, name, fault);
  throw StorageError("the " + wanted.artifact + " of job " + wanted.job + " changed while it was read: read it again");
}

void Artifacts::refuse_damaged(const JobRecord& record, const std::string& artifact, const std::string& file,
                               const std::string& fault) const {
  const std::string& job = record.id;
  find_job(store_, job);  // it may be gone by now, and its files with it
  const std::string sentence = "the file " + file + " of job " + job + " is damaged: it " + fault;
  spdlog::error("job={} {}", job, sentence);
  if (is_export(artifact, file)) {
    break_seal(folder(), record.folder, file);
    throw proto::ProtocolError("artifact_damaged", sentence + ": ask for it again, then it is made anew");
  }
  store_.note_damage(job, sentence + ": plan it again with 'sculpt retry " + job + "'");
  throw proto::ProtocolError("artifact_damaged", sentence + ": plan it again with 'sculpt retry " + job + "'");
}

bool Artifacts::needs_export(const proto::ArtifactReadParams& wanted) const {
  const std::string format = choose_format(wanted);
  if (is_own(find_kind(wanted.artifact), format)) return false;
  return !read_seal(folder(), find_job(store_, wanted.job).folder, file_name(wanted.artifact, format));
}

void Artifacts::make_export(const proto::ArtifactReadParams& wanted) const {
  if (!needs_export(wanted)) return;
  const JobRecord job = find_job(store_, wanted.job);
  if (!find_stored(store_.artifacts(job.id), wanted.artifact)) {
    refuse_missing(job, "final " + wanted.artifact + " to make " + wanted.format + " from; " +
                            find_kind(wanted.artifact).formats.front() + " can be read while it grows");
  }
  check_whole(job, wanted.artifact);
  const std::string name = file_name(wanted.artifact, wanted.format);
  const fs::path file = folder() / job.folder / name;
  const fs::path draft = draft_of(file);
  const Kind& kind = find_kind(wanted.artifact);
  std::ifstream in(folder() / job.folder / file_name(kind.artifact, kind.formats.front()), std::ios::binary);
  std::ofstream out(draft, std::ios::binary | std::ios::trunc);
  rewrite_to(wanted.format, planner_)(in, out);
  out.close();
  if (!out) throw StorageError("cannot write '" + draft.string() + "': check the free space");
  sync_to_disk(draft);
  crash_point(CrashPoint::export_synced);
  fs::rename(draft, file);
  write_seal(folder(), job.folder, name);
}

std::string Artifacts::read_whole(const JobRecord& job, const std::string& artifact) const {
  proto::ArtifactReadParams all{job.id, artifact, {}, 0, 0};
  const std::optional<StoredArtifact> stored = find_stored(store_.artifacts(job.id), artifact);
  if (!stored) refuse_missing(job, artifact);
  all.bytes = stored->size;
  WholeRead whole;
  return read(all, whole).bytes;
}

void Artifacts::check_whole(const JobRecord& job, const std::string& artifact) const {
  const std::optional<StoredArtifact> stored = find_stored(store_.artifacts(job.id), artifact);
  if (!stored) refuse_missing(job, artifact);
  const std::string name = file_name(artifact, stored->format);
  files_.fetch(job.folder, name);
  const FileSeal seal{stored->size, stored->sha256};
  std::string fault = fault_of(StoredFile::open(folder(), job.folder, name), seal);
  if (!fault.empty() && files_.shared() != nullptr) {  // it may be the copy that is bad
    std::error_code ignored;
    fs::remove(folder() / job.folder / name, ignored);
    fault = fault_of(files_.open(job.folder, name), seal);
    if (fault.empty()) files_.fetch(job.folder, name);
  }
  if (!fault.empty()) refuse_damaged(job, artifact, name, fault);
}

std::string Artifacts::file_name_of(const proto::ArtifactReadParams& wanted) const {
  return file_name(wanted.artifact, choose_format(wanted));
}

}  // namespace sculpt::server
