// fsck: the files of jobs and uploads against what the store says of them.
#include <set>

#include "proto/cell_bundle.hpp"
#include "server/files/blobs.hpp"
#include "server/files/orphans.hpp"
#include "server/files/stored_file.hpp"
#include "server/ops/fsck.hpp"
#include "server/results/exported_file.hpp"
#include "server/results/programs.hpp"
#include "server/run/job_run.hpp"
#include "server/store/job_store.hpp"
#include "server/store/sqlite/sqlite.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

constexpr int page = 100;

std::vector<fs::path> entries(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code missing;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, missing)) found.push_back(entry.path());
  std::ranges::sort(found);
  return found;
}

std::string retry_command(const std::string& job) {
  return "'sculpt retry " + job + "'";
}

Fault damaged_artifact(JobStore& store, const std::string& job, const std::string& file, const std::string& fault) {
  const std::string what = "job " + job + ": its " + file + " " + fault;
  return {what, "the job says so, and " + retry_command(job) + " plans it again", [&store, job, file, fault] {
            store.note_damage(job, "the file " + file + " of job " + job + " is damaged: it " + fault +
                                       ": plan it again with " + retry_command(job));
          }};
}

// What was made of an artifact can be made again.
void check_export(const fs::path& jobs, const std::string& job, const std::string& file, std::vector<Fault>& faults) {
  const std::optional<FileSeal> seal = read_seal(jobs, job, file);
  if (!seal) return;
  const std::string fault = fault_of(StoredFile::open(jobs, job, file), *seal);
  if (fault.empty()) return;
  faults.push_back({"job " + job + ": its " + file + " " + fault, "it is made again when it is asked for",
                    [jobs, job, file] { break_seal(jobs, job, file); }});
}

// A bundle whose hash is wrong is a fault already, and says nothing.
std::vector<std::string> bundle_files(const Blobs& blobs, const std::string& bundle) try {
  std::vector<std::string> files;
  for (const auto& [reference, sha256] : proto::read_cell_bundle(blobs.read(bundle, "")).files) files.push_back(sha256);
  return files;
} catch (const std::runtime_error&) {
  return {};
}

// The blobs that jobs need, each with the first job that does. Rows that cannot be read are faults already.
std::map<std::string, std::string> needed_blobs(JobStore& store, const Blobs& blobs) {
  std::map<std::string, std::string> needed;
  JobWindow window{.limit = page};
  for (bool more = true; more;) {
    const JobPage found = store.list(window);
    for (const JobRecord& job : found.jobs) {
      const proto::JobSpec spec = read_stored_spec(job);
      needed.emplace(spec.mesh.sha256, job.id);
      if (spec.stock_mesh) needed.emplace(spec.stock_mesh->sha256, job.id);
      for (const proto::ClampingSpec& clamping : spec.clampings) needed.emplace(clamping.left, job.id);
      if (!needed.emplace(job.cell_bundle, job.id).second) continue;
      for (const std::string& file : bundle_files(blobs, job.cell_bundle)) needed.emplace(file, job.id);
    }
    more = found.more;
    if (more) window.after = found.jobs.back().id;
  }
  return needed;
}

void put_blob_aside(const FolderPaths& folder, const fs::path& blob) {
  const fs::path aside = folder.folder / "blobs.damaged";
  fs::create_directories(aside);
  fs::rename(blob, aside / blob.filename());
}

}  // namespace

std::vector<Fault> find_missing_blobs(const FolderPaths& folder, JobStore& store) {
  std::vector<Fault> faults;
  const Blobs blobs(folder.blobs(), 0);
  for (const auto& [sha256, job] : needed_blobs(store, blobs)) {
    if (blobs.state(sha256).complete) continue;
    faults.push_back({"job " + job + ": its blob " + sha256 + " is missing", "upload it again: submit the same files"});
  }
  return faults;
}

std::vector<Fault> find_artifact_faults(const FolderPaths& folder, Database& database, JobStore& store) {
  std::vector<Fault> faults;
  Statement stored(database,
                   "SELECT id, artifact || '.' || format, size, sha256 FROM artifact JOIN job ON artifact.job = "
                   "job.number ORDER BY job.number, place");
  while (stored.step()) {
    const std::string job = stored.text(0), file = stored.text(1);
    const FileSeal seal{static_cast<std::uint64_t>(stored.number(2)), stored.text(3)};
    const std::string fault = fault_of(StoredFile::open(folder.jobs(), job, file), seal);
    if (!fault.empty()) faults.push_back(damaged_artifact(store, job, file, fault));
    if (file == "timeline.tokens") check_export(folder.jobs(), job, "timeline.gz", faults);
    if (file != "trajectory.ndjson") continue;
    for (const char* made : {"trajectory.csv", "trajectory.sct"}) check_export(folder.jobs(), job, made, faults);
    for (const std::string& made : program_files(folder.jobs(), job)) check_export(folder.jobs(), job, made, faults);
  }
  Statement empty(database,
                  "SELECT id FROM job WHERE state='succeeded' AND NOT EXISTS(SELECT 1 FROM artifact WHERE artifact.job "
                  "= job.number AND artifact='trajectory') ORDER BY number");
  while (empty.step())
    faults.push_back({"job " + empty.text(0) + ": it succeeded without a trajectory", "submit it again"});
  return faults;
}

std::vector<Fault> find_blob_faults(const FolderPaths& folder) {
  std::vector<Fault> faults;
  for (const fs::path& shelf : entries(folder.blobs())) {
    if (!fs::is_directory(shelf)) continue;
    for (const fs::path& blob : entries(shelf)) {
      const std::string name = blob.filename();
      const std::optional<StoredFile> file = StoredFile::open(folder.blobs(), shelf.filename(), name);
      if (blob.extension() == ".draft" || (file && file->seal().sha256 == name)) continue;
      faults.push_back({"blob " + name + ": its bytes have another hash",
                        "it goes to blobs.damaged, and can be uploaded again",
                        [folder, blob] { put_blob_aside(folder, blob); }});
    }
  }
  return faults;
}

std::vector<Fault> find_stray_faults(const FolderPaths& folder, JobStore& store) {
  std::vector<Fault> faults;
  std::vector<fs::path> places{folder.folder, folder.blobs()};
  for (const fs::path& job : entries(folder.jobs())) {
    const std::string name = job.filename();
    if (store.find(name) || store.was_removed(name)) {
      places.push_back(job);
      continue;
    }
    faults.push_back({"job folder " + name + ": no job has it", "it goes to jobs.orphaned",
                      [jobs = folder.jobs(), name] { put_aside(jobs, name); }});
  }
  for (const fs::path& place : places) {
    for (const fs::path& file : entries(place)) {
      if (file.extension() != ".draft") continue;
      faults.push_back({"'" + file.string() + "' was never finished", "it is removed", [file] { fs::remove(file); }});
    }
  }
  return faults;
}

}  // namespace sculpt::server
