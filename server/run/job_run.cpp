#include "server/run/job_run.hpp"

#include <fstream>
#include <vector>

#include "core/base/sha256.hpp"
#include "core/plan/checkpoint/checkpoint_folder.hpp"
#include "proto/cell_bundle.hpp"
#include "server/base/crash_point.hpp"
#include "server/base/storage_error.hpp"
#include "server/files/durable.hpp"
#include "server/files/job_folder.hpp"
#include "server/run/inheritance.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t read_bytes = 1 << 20;

StoredArtifact stored(const fs::path& file, const std::string& artifact, const std::string& format) {
  std::ifstream in(file, std::ios::binary);
  Sha256 hash;
  StoredArtifact out{artifact, format, 0, {}};
  std::vector<char> buffer(read_bytes);
  while (in.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || in.gcount() > 0) {
    hash.add({buffer.data(), static_cast<std::size_t>(in.gcount())});
    out.size += static_cast<std::uint64_t>(in.gcount());
  }
  out.sha256 = hash.hex();
  return out;
}

std::string finished_report(const JobRecord& job, const Ending& ending, const std::string& report_json) {
  Json report{{"job", job.id}, {"state", name(ending.state)}};
  report.update(proto::parse_json(report_json));
  return proto::write_json(report);
}

Ending judged(const PlanFiles& files) {
  if (files.clean && files.unkept) return {JobState::failed, files.unkept->code(), files.unkept->what(), {}};
  if (files.clean) return {JobState::succeeded, {}, {}, {}};
  return {JobState::failed,
          "verify_failed",
          "the replay of the plan found " + std::to_string(files.collisions) +
              " faults, so it must not be run; the first: " + files.first_finding,
          {}};
}

}  // namespace

Ending run_in_folder(const JobRecord& record, const Job& job, const fs::path& folder, const Planner& planner,
                     const Watch& watch) {
  const fs::path trajectory = folder / "trajectory.ndjson";
  const PlanFiles files = planner.run(job, trajectory, watch);
  crash_point(CrashPoint::trajectory_planned);
  Ending ending = judged(files);
  write_durably(folder / "voxels.binvox", files.voxels_binvox);
  write_durably(folder / "stock.binvox", files.stock_binvox);
  write_durably(folder / "residue.ndjson", files.residue_ndjson);
  write_durably(folder / "report.json", finished_report(record, ending, files.report_json));
  sync_to_disk(trajectory);
  sync_to_disk(folder / timeline_file);
  sync_to_disk(folder);
  crash_point(CrashPoint::artifacts_synced);
  ending.artifacts = {stored(trajectory, "trajectory", "ndjson"),
                      stored(folder / timeline_file, "timeline", "tokens"),
                      stored(folder / "voxels.binvox", "voxels", "binvox"),
                      stored(folder / "stock.binvox", "stock", "binvox"),
                      stored(folder / "residue.ndjson", "residue", "ndjson"),
                      stored(folder / "report.json", "report", "json")};
  remove_checkpoints(folder);
  return ending;
}

proto::JobSpec read_stored_spec(const JobRecord& job) {
  try {
    const Json json = proto::parse_json(job.spec);
    proto::JobSpec spec = proto::read_job_spec(proto::Fields(json, "/params/spec"));
    if (!job.inherited.empty()) read_inherited(job.inherited, spec);
    return spec;
  } catch (const std::runtime_error& error) {
    throw StorageError("the stored spec of job " + job.id + " cannot be read: " + error.what());
  }
}

std::set<std::string> blobs_of(const JobRecord& job, const Blobs& blobs, std::set<std::string>& bundles) {
  const proto::JobSpec spec = read_stored_spec(job);
  std::set<std::string> needed{spec.mesh.sha256, job.cell_bundle};
  if (spec.stock_mesh) needed.insert(spec.stock_mesh->sha256);
  for (const proto::ClampingSpec& clamping : spec.clampings) needed.insert(clamping.left);
  if (!bundles.insert(job.cell_bundle).second) return needed;
  for (const auto& [reference, sha256] : proto::read_cell_bundle(blobs.read(job.cell_bundle, "")).files)
    needed.insert(sha256);
  return needed;
}

void fetch_blobs(const JobRecord& job, const Blobs& blobs) {
  std::set<std::string> bundles;
  for (const std::string& blob : blobs_of(job, blobs, bundles)) blobs.use(blob);
}

RunJob make_run_job(const Planner& planner, const Blobs& blobs, const fs::path& jobs, const JobDefaults& defaults) {
  return [&planner, &blobs, jobs, defaults](const JobRecord& record, const Watch& watch) {
    const fs::path folder = prepare_job_folder(jobs, record.folder);
    const Job job = to_job(read_stored_spec(record), record.cell_bundle, blobs, defaults);
    return run_in_folder(record, job, folder, planner, watch);
  };
}

}  // namespace sculpt::server
