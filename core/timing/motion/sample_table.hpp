// A motion at a fixed rate, as bytes: what a driver asks for window by window.
#pragma once

#include <cstdint>
#include <string>

#include "core/timing/motion/sampler.hpp"

namespace sculpt {

/// The k-th sample is at k / rate_hz s from the start of the motion; the last is the first that stands at its end.
struct SampleRate {
  double hz = 0;  ///< above 0

  /// Of the sample that is at `time_s` or the next one behind it.
  std::uint64_t first_from(double time_s) const;
  /// Of a motion that takes so long.
  std::uint64_t last_of(double duration_s) const { return first_from(duration_s); }
  double time_of(std::uint64_t sample) const { return static_cast<double>(sample) / hz; }
};

/// A sample a row: q of each joint (rad or m), then the velocity of each (1/s), as little-endian doubles.
std::string sample_rows(MotionSampler& sampler, const SampleRate& rate, std::uint64_t first, std::uint64_t count);
constexpr std::size_t sample_row_bytes(std::size_t dof) {
  return 2 * dof * sizeof(double);
}

}  // namespace sculpt
