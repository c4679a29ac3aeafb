#include "server/results/motions.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "core/law/law_file.hpp"
#include "core/timing/motion/sample_table.hpp"
#include "server/base/storage_error.hpp"
#include "server/results/isolated_timing.hpp"
#include "server/run/job_run.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

[[noreturn]] void refuse_window(const std::string& sentence) {
  throw proto::ProtocolError("window_empty", sentence, "/params/from_s");
}

std::string key_of(const JobRecord& job, const proto::SamplesParams& wanted) {
  return job.id + " " + job.folder + " " + proto::write_json(to_json(wanted.motion));
}

PlanPath read_path(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return PlanPath(in);
}

LawFile take_law(const fs::path& jobs, const std::string& folder) {
  const std::optional<StoredFile> file = StoredFile::open(jobs, folder, law_file);
  if (!file) throw StorageError("the process that timed the job left no time law: check the space on the disk");
  std::istringstream in(file->read(0, file->size()));
  std::error_code ignored;
  fs::remove(jobs / folder / law_file, ignored);
  return read_law(in);
}

}  // namespace

struct Motions::LoadedMotion {
  LoadedMotion(std::string of, PlanPath&& along, TimeLaw&& by)
      : key(std::move(of)), path(std::move(along)), law(std::move(by)), sampler(path, law) {}

  std::size_t bytes() const {
    return path.size() * (path.dof() * sizeof(double) + sizeof(PlanPath::Edge)) +
           law.corners.size() * sizeof(LawCorner);
  }

  const std::string key;
  const PlanPath path;
  const TimeLaw law;
  std::mutex turn;  ///< of whoever uses the two below
  MotionSampler sampler;
  std::optional<std::vector<double>> holds_s = std::vector<double>{};  ///< nothing: the sampler's are not whole
};

Motions::Motions(const Artifacts& artifacts, const Blobs& blobs, const Isolation& isolation, std::size_t most)
    : artifacts_(artifacts), blobs_(blobs), isolation_(isolation), most_(most) {}

Motions::~Motions() = default;

std::shared_ptr<Motions::LoadedMotion> Motions::make(const JobRecord& job, const proto::SamplesParams& wanted,
                                                     const std::stop_token& stop) {
  artifacts_.check_whole(job, "trajectory");
  fetch_blobs(job, blobs_);
  proto::JobSpec spec = read_stored_spec(job);
  spec.motion = wanted.motion;
  time_in_child({proto::write_json(to_json(spec)), job.cell_bundle, job.id, 0, job.inherited, job.folder}, isolation_,
                stop);
  LawFile law = take_law(artifacts_.files().folder(), job.folder);
  PlanPath path = read_path(artifacts_.files().folder() / job.folder / "trajectory.ndjson");
  if (mark_of(path) != law.plan)
    throw StorageError("the time law of job " + job.id + " is not that of its trajectory: ask again");
  return std::make_shared<LoadedMotion>(key_of(job, wanted), std::move(path), std::move(law.law));
}

std::shared_ptr<Motions::LoadedMotion> Motions::find_kept(const std::string& key) {
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find(kept_, key, [](const auto& motion) { return motion->key; });
  if (found == kept_.end()) return nullptr;
  kept_.splice(kept_.begin(), kept_, found);
  return kept_.front();
}

bool Motions::has(const JobRecord& job, const proto::SamplesParams& wanted) {
  return find_kept(key_of(job, wanted)) != nullptr;
}

std::shared_ptr<Motions::LoadedMotion> Motions::find(const JobRecord& job, const proto::SamplesParams& wanted,
                                                     const std::stop_token& stop) {
  const std::string key = key_of(job, wanted);
  if (auto kept = find_kept(key)) return kept;
  const std::lock_guard alone(making_);
  if (auto kept = find_kept(key)) return kept;  // somebody else was faster
  std::shared_ptr<LoadedMotion> made = make(job, wanted, stop);
  const std::lock_guard lock(mutex_);
  kept_.push_front(made);
  std::size_t bytes = 0;
  for (const auto& motion : kept_) bytes += motion->bytes();
  for (; bytes > most_ && kept_.size() > 1; kept_.pop_back()) bytes -= kept_.back()->bytes();
  return made;
}

SampleWindow Motions::window(const JobRecord& job, const proto::SamplesParams& wanted, std::size_t max_bytes,
                             const std::stop_token& stop) {
  const std::shared_ptr<LoadedMotion> found = find(job, wanted, stop);
  LoadedMotion& motion = *found;
  const std::lock_guard turn(motion.turn);
  if (motion.holds_s != wanted.holds_s) {
    motion.holds_s.reset();  // where these cannot be, the next ones begin anew
    motion.sampler.hold(wanted.holds_s);
    motion.holds_s = wanted.holds_s;
  }
  const SampleRate rate{wanted.rate_hz};
  SampleWindow window{motion.path.header().joints,
                      motion.sampler.duration_s(),
                      rate.first_from(wanted.from_s),
                      0,
                      0,
                      motion.sampler.holds(),
                      {}};
  const std::uint64_t last = rate.last_of(window.duration_s);
  window.samples = last + 1;
  if (window.first > last)
    refuse_window("the motion ends at " + text(window.duration_s) + " s: ask for less than from_s " +
                  text(wanted.from_s));
  std::uint64_t end = last + 1;  // behind the last one that is wanted
  if (wanted.to_s) end = std::min(end, static_cast<std::uint64_t>(std::floor(*wanted.to_s * rate.hz + 1e-9)) + 1);
  if (end <= window.first)
    refuse_window("no sample is between from_s " + text(wanted.from_s) + " and to_s " + text(*wanted.to_s) + " at " +
                  text(rate.hz) + " Hz: ask for a longer window");
  const std::uint64_t fit = std::max<std::uint64_t>(1, max_bytes / sample_row_bytes(motion.path.dof()));
  window.count = std::min({end - window.first, wanted.count, fit});
  window.rows = sample_rows(motion.sampler, rate, window.first, window.count);
  return window;
}

}  // namespace sculpt::server
