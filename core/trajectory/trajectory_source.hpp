// What the two forms of a trajectory file have in common for who reads one. Internal to trajectory/.
#pragma once

#include <cstdint>
#include <optional>

#include "core/trajectory/header.hpp"
#include "core/trajectory/keyframe.hpp"

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

}  // namespace sculpt
