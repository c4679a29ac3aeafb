#include "server/results/artifacts.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <fstream>
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

// Writes another form of an artifact from its own.
void rewrite(const std::string& format, const Planner& planner, const fs::path& from, const fs::path& to) {
  std::ifstream in(from, std::ios::binary);
  std::ofstream out(to, std::ios::binary | std::ios::trunc);
  if (format == "gzip")
    write_gzip(in, out);
  else
    (format == "csv" ? planner.to_csv : planner.to_binary)(in, out);
  out.close();
  if (!out) throw StorageError("cannot write '" + to.string() + "': check the free space");
}

// Those that were made of a final artifact, with their seals.
Json list_exports(const fs::path& folder, const std::string& job, const ArtifactKind& kind) {
  if (kind.formats.front().origin == Origin::program) return list_programs(folder, job);
  Json made = Json::array();
  for (const std::string& format : kind.format_names()) {
    const std::optional<FileSeal> seal = read_seal(folder, job, form_of(kind, format).file);
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

// What a run wrote; the other forms are made here from that.
std::optional<StoredFile> Artifacts::open(const JobRecord& job, const ArtifactForm& form) const {
  return form.is_own() ? files_.open(job.folder, form.file) : StoredFile::open(folder(), job.folder, form.file);
}

Json Artifacts::list(const JobRecord& job) const {
  const std::vector<StoredArtifact> stored = store_.artifacts(job.id);
  Json list = Json::array();
  for (const ArtifactKind& kind : artifact_kinds()) {
    Json entry{{"artifact", kind.artifact}, {"formats", kind.format_names()}};
    if (const std::optional<StoredArtifact> artifact = find_stored(stored, kind.artifact)) {
      entry.update({{"size", artifact->size}, {"final", true}, {"sha256", artifact->sha256}});
    } else {
      entry.update(
          {{"size", kind.grows ? size_now(files_.open(job.folder, form_of(kind).file)) : 0}, {"final", false}});
    }
    if (!stored.empty())
      if (Json made = list_exports(folder(), job.folder, kind); !made.empty()) entry["made"] = std::move(made);
    list.push_back(std::move(entry));
  }
  return list;
}

std::optional<FileSeal> Artifacts::seal_of(const JobRecord& job, const ArtifactForm& form) const {
  const std::optional<StoredArtifact> stored = find_stored(store_.artifacts(job.id), form.source);
  if (!stored) return std::nullopt;
  if (form.is_own()) return FileSeal{stored->size, stored->sha256};
  return read_seal(folder(), job.folder, form.file);
}

ArtifactChunk Artifacts::read(const proto::ArtifactReadParams& wanted, WholeRead& so_far) const {
  const ArtifactForm form = find_form(wanted);
  ArtifactChunk chunk;
  chunk.format = form.format;
  const JobRecord job = find_job(store_, wanted.job);
  const std::optional<FileSeal> seal = seal_of(job, form);
  chunk.final = seal.has_value();
  const bool grows = form.kind->grows && form.is_own() && !is_final(job.state);
  if (!chunk.final && !grows) refuse_missing(job, "final " + wanted.artifact);
  const std::optional<StoredFile> file = open(job, form);
  if (const std::string fault = seal ? fault_of_size(file, *seal) : ""; !fault.empty())
    refuse_damaged(job, form, fault);
  if (seal) chunk.sha256 = seal->sha256;
  chunk.size = size_now(file);
  if (chunk.final && wanted.offset > chunk.size) {
    throw proto::ProtocolError("params_invalid",
                               "offset " + std::to_string(wanted.offset) + " is beyond the artifact's " +
                                   std::to_string(chunk.size) + " bytes",
                               "/params/offset");
  }
  const std::uint64_t left = chunk.size > wanted.offset ? chunk.size - wanted.offset : 0;
  if (file) chunk.bytes = file->read(wanted.offset, std::min<std::uint64_t>(left, wanted.bytes));
  follow(job, wanted, chunk, so_far);
  return chunk;
}

// A growing trajectory is followed too: it may be final at its last piece.
void Artifacts::follow(const JobRecord& job, const proto::ArtifactReadParams& wanted, const ArtifactChunk& chunk,
                       WholeRead& so_far) const {
  const ArtifactForm form = find_form(wanted);
  if (wanted.offset == 0) so_far = {wanted.job, form.file, 0, {}};
  if (so_far.job != wanted.job || so_far.file != form.file || so_far.next != wanted.offset) return;
  so_far.hash.add(chunk.bytes);
  so_far.next += chunk.bytes.size();
  if (!chunk.final || so_far.next < chunk.size || so_far.hash.hex() == chunk.sha256) return;
  const std::string fault = fault_of(open(job, form), {chunk.size, chunk.sha256});
  if (!fault.empty()) refuse_damaged(job, form, fault);
  throw StorageError("the " + wanted.artifact + " of job " + wanted.job + " changed while it was read: read it again");
}

void Artifacts::refuse_damaged(const JobRecord& record, const ArtifactForm& form, const std::string& fault) const {
  const std::string& job = record.id;
  find_job(store_, job);  // it may be gone by now, and its files with it
  const std::string sentence = "the file " + form.file + " of job " + job + " is damaged: it " + fault;
  spdlog::error("job={} {}", job, sentence);
  if (!form.is_own()) {
    break_seal(folder(), record.folder, form.file);
    throw proto::ProtocolError("artifact_damaged", sentence + ": ask for it again, then it is made anew");
  }
  store_.note_damage(job, sentence + ": plan it again with 'sculpt retry " + job + "'");
  throw proto::ProtocolError("artifact_damaged", sentence + ": plan it again with 'sculpt retry " + job + "'");
}

bool Artifacts::needs_export(const proto::ArtifactReadParams& wanted) const {
  const ArtifactForm form = find_form(wanted);
  return !form.is_own() && !read_seal(folder(), find_job(store_, wanted.job).folder, form.file);
}

void Artifacts::make_export(const proto::ArtifactReadParams& wanted, const std::stop_token& stop) const {
  if (!needs_export(wanted)) return;
  const ArtifactForm form = find_form(wanted);
  const JobRecord job = find_job(store_, wanted.job);
  if (!find_stored(store_.artifacts(job.id), form.source))
    refuse_missing(job, "final " + form.source + " to make " + form.format + " from");
  check_whole(job, form.source);
  const fs::path place = folder() / job.folder, file = place / form.file, draft = draft_of(file);
  if (wanted.program)
    programs_.make(job, *wanted.program, draft, stop);
  else if (form.origin == Origin::job)
    machined_.make(job, form, draft, stop);
  else
    rewrite(form.format, planner_, place / form_of(*form.kind).file, draft);
  sync_to_disk(draft);
  crash_point(CrashPoint::export_synced);
  fs::rename(draft, file);
  if (wanted.program) programs_.keep(place, *wanted.program);
  write_seal(folder(), job.folder, form.file);
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
  const ArtifactForm form = find_form({job.id, artifact, stored->format, 0, 0});
  files_.fetch(job.folder, form.file);
  const FileSeal seal{stored->size, stored->sha256};
  std::string fault = fault_of(StoredFile::open(folder(), job.folder, form.file), seal);
  if (!fault.empty() && files_.shared() != nullptr) {  // it may be the copy that is bad
    std::error_code ignored;
    fs::remove(folder() / job.folder / form.file, ignored);
    fault = fault_of(files_.open(job.folder, form.file), seal);
    if (fault.empty()) files_.fetch(job.folder, form.file);
  }
  if (!fault.empty()) refuse_damaged(job, form, fault);
}

}  // namespace sculpt::server
