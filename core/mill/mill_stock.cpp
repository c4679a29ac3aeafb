#include "core/mill/mill_stock.hpp"

#include <bit>
#include <numbers>

namespace sculpt {
namespace {

/// Takes a run out of the set; how many were in it.
std::uint32_t take(VoxelSet& set, const SweptCutter::Run& run) {
  const std::size_t low = set.index({run.first, run.j, run.k}), high = set.index({run.last, run.j, run.k});
  std::uint32_t taken = 0;
  for (std::size_t word = low >> 6; word <= high >> 6; ++word) {
    std::uint64_t mask = ~std::uint64_t{0};
    if (word == low >> 6) mask &= ~std::uint64_t{0} << (low & 63);
    if (word == high >> 6) mask &= ~std::uint64_t{0} >> (63 - (high & 63));
    taken += static_cast<std::uint32_t>(std::popcount(set.words()[word] & mask));
    set.words()[word] &= ~mask;
  }
  return taken;
}

}  // namespace

MillSweeps::MillSweeps(const Cutter& cutter, const Direction& direction, double stray_m, double voxel_m)
    : of_centres(cutter, direction, stray_m),
      of_cubes(cutter, direction, stray_m + voxel_m * std::numbers::sqrt3 / 2) {}

std::uint32_t MillStock::remove(const MillSweeps& sweeps, const QuantaPoint& from, const QuantaPoint& to) {
  std::uint32_t removed = 0;
  sweeps.of_centres.for_each_run(centres_, from, to, left_,
                                 [&](const SweptCutter::Run& run) { removed += take(left_, run); });
  return removed;
}

void MillStock::clear(const MillSweeps& sweeps, const QuantaPoint& from, const QuantaPoint& to) {
  sweeps.of_cubes.for_each_run(centres_, from, to, standing_,
                               [&](const SweptCutter::Run& run) { take(standing_, run); });
}

}  // namespace sculpt
