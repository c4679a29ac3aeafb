// Finished jobs -> their motions at fixed rates, window by window. Those that were asked for last are kept in memory.
#pragma once

#include <list>
#include <memory>
#include <mutex>
#include <stop_token>

#include "core/timing/motion/held_pieces.hpp"
#include "server/files/blobs.hpp"
#include "server/results/artifacts.hpp"
#include "server/run/job_description.hpp"

namespace sculpt::server {

/// Of a motion, as job.samples answers.
struct SampleWindow {
  std::vector<std::string> joints;
  double duration_s = 0;
  std::uint64_t first = 0;  ///< of the motion's samples, the window's first one: the k-th is at k / rate_hz
  std::uint64_t count = 0;
  std::uint64_t samples = 0;  ///< that the whole motion has
  std::vector<PathHold> holds;
  std::string rows;  ///< core/timing/motion/sample_table.hpp
};

/// Safe from any thread.
class Motions {
 public:
  /// What is kept of all motions together, in bytes; but the last one always is.
  static constexpr std::size_t usual_bytes = 512u << 20;
  /// All must outlive the object.
  Motions(const Artifacts& artifacts, const Blobs& blobs, const Isolation& isolation, std::size_t most = usual_bytes);
  ~Motions();

  /// Whether it was asked for of late, so that `window` finds it and need not find its time law first.
  bool has(const JobRecord& job, const proto::SamplesParams& wanted);
  /// At most so many bytes of rows, and at least one sample. Finds the time law first, in a process of its own, unless
  /// it has the motion. Throws ProtocolError `wrong_state`, `artifact_damaged`, `window_empty` (nothing of the motion
  /// is in it); InputError as time_plan and `run_time_exceeded`; Cancelled.
  SampleWindow window(const JobRecord& job, const proto::SamplesParams& wanted, std::size_t max_bytes,
                      const std::stop_token& stop);

 private:
  struct LoadedMotion;
  std::shared_ptr<LoadedMotion> find_kept(const std::string& key);
  std::shared_ptr<LoadedMotion> find(const JobRecord& job, const proto::SamplesParams& wanted,
                                     const std::stop_token& stop);
  std::shared_ptr<LoadedMotion> make(const JobRecord& job, const proto::SamplesParams& wanted,
                                     const std::stop_token& stop);

  const Artifacts& artifacts_;
  const Blobs& blobs_;
  const Isolation& isolation_;
  const std::size_t most_;
  std::mutex making_;  ///< one law at a time: each comes as the same file of its job's folder
  std::mutex mutex_;   ///< of what is kept
  std::list<std::shared_ptr<LoadedMotion>> kept_;  ///< the one that was asked for last comes first
};

}  // namespace sculpt::server
