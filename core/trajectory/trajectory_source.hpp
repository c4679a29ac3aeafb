// The two forms that TrajectoryReader reads. Internal to trajectory/.
#pragma once

#include <memory>

#include "core/trajectory/trajectory.hpp"

namespace sculpt {

/// Same contract as TrajectoryReader.
class TrajectorySource {
 public:
  virtual ~TrajectorySource() = default;
  virtual std::optional<Keyframe> next() = 0;

  const TrajectoryHeader& header() const { return header_; }
  std::uint64_t keyframes() const { return keyframes_; }

 protected:
  void count(const Keyframe& keyframe) {
    ++keyframes_;
    removed_ += static_cast<std::uint64_t>(run_length(keyframe));
  }

  TrajectoryHeader header_;
  std::uint64_t keyframes_ = 0, removed_ = 0;  // given out so far
  bool finished_ = false;
};

std::unique_ptr<TrajectorySource> open_text(std::istream& in);
std::unique_ptr<TrajectorySource> open_binary(std::istream& in);

}  // namespace sculpt
