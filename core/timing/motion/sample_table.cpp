#include "core/timing/motion/sample_table.hpp"

#include <bit>
#include <cmath>
#include <cstring>

namespace sculpt {

static_assert(std::endian::native == std::endian::little, "rows are written as they lie in memory");

std::uint64_t SampleRate::first_from(double time_s) const {
  // What differs from a sample's time by its rounding only is that sample's.
  return static_cast<std::uint64_t>(std::ceil(std::max(0.0, time_s * hz - 1e-9)));
}

std::string sample_rows(MotionSampler& sampler, const SampleRate& rate, std::uint64_t first, std::uint64_t count) {
  std::string rows;
  char* out = nullptr;
  for (std::uint64_t at = 0; at < count; ++at) {
    const MotionSample sample = sampler.at(rate.time_of(first + at));
    const std::size_t half = static_cast<std::size_t>(sample.q.size()) * sizeof(double);
    if (out == nullptr) {
      rows.resize(2 * half * count);
      out = rows.data();
    }
    std::memcpy(out, sample.q.data(), half);
    std::memcpy(out + half, sample.velocity.data(), half);
    out += 2 * half;
  }
  return rows;
}

}  // namespace sculpt
