#include "core/trajectory/milling/swept_set.hpp"

#include <bit>

namespace sculpt {

std::uint32_t SweptSet::take(const SweptCutter& cutter, const QuantaPoint& from, const QuantaPoint& to, Taken* taken) {
  std::uint32_t count = 0;
  cutter.for_each_run(centres_, from, to, voxels_, [&](const SweptCutter::Run& run) {
    const std::size_t low = voxels_.index({run.first, run.j, run.k}), high = voxels_.index({run.last, run.j, run.k});
    for (std::size_t word = low >> 6; word <= high >> 6; ++word) {
      std::uint64_t bits = voxels_.words()[word];
      if (word == low >> 6) bits &= ~std::uint64_t{0} << (low & 63);
      if (word == high >> 6) bits &= ~std::uint64_t{0} >> (63 - (high & 63));
      if (bits == 0) continue;
      voxels_.words()[word] &= ~bits;
      count += static_cast<std::uint32_t>(std::popcount(bits));
      if (taken) taken->emplace_back(word, bits);
    }
  });
  return count;
}

void SweptSet::give_back(const Taken& taken) {
  for (const auto& [word, bits] : taken) voxels_.words()[word] |= bits;
}

}  // namespace sculpt
