#include "core/verify/material/cut_log.hpp"

#include <algorithm>

#include "core/verify/material/held_voxels.hpp"

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
  VoxelSet left = stock;
  for (const Cut& cut : cuts_) left.erase(voxel(cut.first), voxel(cut.last));
  HeldVoxels held(left);
  std::vector<FreedPiece> pieces;
  std::vector<HeldVoxels::Gain> gains;
  for (std::size_t at = cuts_.size(); at-- > 0;) {
    if (at % cuts_a_step == 0) step();
    const Voxel first = voxel(cuts_[at].first), last = voxel(cuts_[at].last);
    const Voxel back = sign(first - last);
    for (int part = 0; part <= l1(first, last); ++part) {
      const Voxel removed = last + back * part;
      gains.clear();
      held.put_back({&removed, 1}, may_fall, gains);
      if (gains.empty()) continue;
      FreedPiece& piece = pieces.emplace_back(cuts_[at].line, removed, 0, 0);
      for (const HeldVoxels::Gain& gain : gains) {
        piece.voxels += gain.all;
        piece.unforeseen += gain.unforeseen;
      }
    }
  }
  std::reverse(pieces.begin(), pieces.end());
  return pieces;
}

}  // namespace sculpt
