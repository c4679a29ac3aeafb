// Finished jobs -> their motions at fixed rates, window by window. The last few that were asked for are kept in memory.
#pragma once

#include <list>
#include <memory>
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

/// Belongs to one thread at a time.
class Motions {
 public:
  /// All must outlive the object.
  Motions(const Artifacts& artifacts, const Blobs& blobs, const Isolation& isolation);
  ~Motions();

  /// At most so many bytes of rows, and at least one sample. Finds the time law first, in a process of its own, unless
  /// it is that of a motion that was asked for of late. Throws ProtocolError `wrong_state`, `artifact_damaged`,
  /// `window_empty` (nothing of the motion is in it); InputError as time_plan; Cancelled.
  SampleWindow window(const JobRecord& job, const proto::SamplesParams& wanted, std::size_t max_bytes,
                      const std::stop_token& stop);

 private:
  struct LoadedMotion;
  LoadedMotion& find(const JobRecord& job, const proto::SamplesParams& wanted, const std::stop_token& stop);
  std::unique_ptr<LoadedMotion> make(const JobRecord& job, const proto::SamplesParams& wanted,
                                     const std::stop_token& stop);

  const Artifacts& artifacts_;
  const Blobs& blobs_;
  const Isolation& isolation_;
  std::list<std::unique_ptr<LoadedMotion>> kept_;  ///< the one that was asked for last comes first
};

}  // namespace sculpt::server
