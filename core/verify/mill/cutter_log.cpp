#include "core/verify/mill/cutter_log.hpp"

#include <algorithm>
#include <cmath>

#include "core/verify/findings/slack.hpp"
#include "core/verify/material/held_voxels.hpp"

namespace sculpt {
namespace {

constexpr std::size_t undone_a_step = 4096;

/// A box holds the centres of no more voxels than (side / voxel + 1), along each side.
double voxels_of_chip(const MillTool& tool, double voxel_mm) {
  const double depth = 1000 * tool.max_depth_m, width = 1000 * tool.max_width_m;
  return (chip_slack * depth / voxel_mm + 1) * std::pow(chip_slack * width / voxel_mm + 1, 2);
}

}  // namespace

void CutterLog::add(std::uint64_t line, const MillTool& tool, std::span<const Voxel> removed) {
  if (removed.empty()) return;
  cuts_.push_back({line, voxels_of_chip(tool, voxel_mm_), rows_.size()});
  for (const Voxel v : removed) {
    const auto index = static_cast<std::uint32_t>(v.i + n_ * (v.j + n_ * v.k));
    if (rows_.size() > cuts_.back().first_row && rows_.back().first + rows_.back().count == index) {
      ++rows_.back().count;
    } else {
      rows_.push_back({index, 1});
    }
  }
}

std::vector<FreedChunk> CutterLog::find_freed(const VoxelSet& left, const VoxelSet& may_fall,
                                              const std::function<void()>& step) const {
  HeldVoxels held(left);
  const auto n = static_cast<std::uint32_t>(n_);
  std::vector<FreedChunk> chunks;
  std::vector<Voxel> voxels;
  std::vector<HeldVoxels::Gain> gains;
  std::size_t end = rows_.size();
  for (std::size_t at = cuts_.size(); at-- > 0; end = cuts_[at].first_row) {
    if (at % undone_a_step == 0) step();
    voxels.clear();
    for (std::size_t row = cuts_[at].first_row; row < end; ++row)
      for (std::uint32_t index = rows_[row].first; index < rows_[row].first + rows_[row].count; ++index)
        voxels.push_back(
            {static_cast<int>(index % n), static_cast<int>(index / n % n), static_cast<int>(index / n / n)});
    gains.clear();
    held.put_back(voxels, may_fall, gains);
    for (const HeldVoxels::Gain& gain : gains)
      if (static_cast<double>(gain.unforeseen) > cuts_[at].chip_voxels)
        chunks.push_back({cuts_[at].line, gain.unforeseen});
  }
  std::reverse(chunks.begin(), chunks.end());
  return chunks;
}

}  // namespace sculpt
