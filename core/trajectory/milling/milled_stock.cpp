#include "core/trajectory/milling/milled_stock.hpp"

#include <bit>

namespace sculpt {

MilledStock::MilledStock(const TrajectoryHeader& header, VoxelSet stock)
    : mill_(*header.mill), stock_(std::move(stock), header.grid) {}

const SweptCutter& MilledStock::cutter(int direction) {
  return cutters_
      .try_emplace(direction, mill_.tools[static_cast<std::size_t>(tool_)].cutter,
                   mill_.directions[static_cast<std::size_t>(direction)], mill_.stray_m)
      .first->second;
}

const std::vector<MilledStock::Run>& MilledStock::take(const MillStep& step, bool cut) {
  runs_.clear();
  if (step.is_change()) {
    tool_ = step.tool;
    cutters_.clear();
  }
  if (cut && step.removed > 0) {
    SweptSet::Taken taken;
    stock_.take(cutter(step.direction), before_.tip, step.tip, &taken);
    find_runs(taken);
  }
  before_ = step;
  return runs_;
}

void MilledStock::find_runs(const SweptSet::Taken& taken) {
  constexpr std::size_t bits_a_word = 64;
  const auto n = static_cast<std::size_t>(standing().n());
  std::size_t first = 0, end = 0;  // of the run in work
  const auto finish = [&] {
    if (first == end) return;
    const auto voxel = [n](std::size_t at) {
      return Voxel{static_cast<int>(at % n), static_cast<int>(at / n % n), static_cast<int>(at / (n * n))};
    };
    runs_.emplace_back(voxel(first), voxel(end - 1));
  };
  for (const auto& [word, bits] : taken)
    for (std::uint64_t left = bits; left != 0;) {
      const int low = std::countr_zero(left), length = std::countr_one(left >> low);
      left = low + length == static_cast<int>(bits_a_word) ? 0 : left >> (low + length) << (low + length);
      const std::size_t begin = bits_a_word * word + static_cast<std::size_t>(low);
      if (begin != end || begin % n == 0) {
        finish();
        first = begin;
      }
      end = begin + static_cast<std::size_t>(length);
    }
  finish();
}

}  // namespace sculpt
