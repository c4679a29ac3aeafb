#include "core/verify/cut_log.hpp"

namespace sculpt {
namespace {

constexpr std::size_t cuts_a_step = 4096;

}  // namespace

void CutLog::add(const Keyframe& cut, std::uint64_t line) {
  const auto index = [this](Voxel v) { return static_cast<std::uint32_t>(v.i + n_ * (v.j + n_ * v.k)); };
  cuts_.push_back({static_cast<std::uint32_t>(line), index(cut.first), index(cut.last)});
  removed_ += static_cast<std::uint64_t>(run_length(cut));
}

Voxel CutLog::voxel(std::uint32_t index) const {
  const auto n = static_cast<std::uint32_t>(n_);
  return {static_cast<int>(index % n), static_cast<int>(index / n % n), static_cast<int>(index / n / n)};
}

bool CutLog::removes_each_once(const VoxelSet& stock, const VoxelSet& left) const {
  return left.size() + removed_ == stock.size();
}

std::vector<FreedPiece> CutLog::find_freed(const VoxelSet& stock, const VoxelSet& may_fall,
                                           const std::function<void()>& step) const {
  const auto line_of = [&](std::size_t cut) {
    if (cut % cuts_a_step == 0) step();
    return VoxelLine{voxel(cuts_[cut].first), voxel(cuts_[cut].last)};
  };
  std::vector<FreedPiece> pieces;
  for (const Loosening& each : find_loose_pieces(stock, may_fall, cuts_.size(), line_of).loosenings)
    pieces.push_back({cuts_[each.line].line, each.removed, each.freed, each.unforeseen});
  return pieces;
}

}  // namespace sculpt
