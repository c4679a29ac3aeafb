// Keyframes -> the figures of a tool.
#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include "core/cell/milling/mill_tool.hpp"
#include "core/mill/chip_load.hpp"
#include "core/mill/tool_figures.hpp"
#include "core/trajectory/keyframe.hpp"

namespace sculpt {

/// Counts what passes by.
class ToolMeter {
 public:
  /// `figures`: what came of the tool before it cut anything.
  ToolMeter(const MillTool& tool, double voxel_m, ToolFigures figures)
      : tool_(tool),
        voxel_m3_(std::pow(voxel_m, 3)),
        window_m_(counted_window_m(tool, voxel_m)),
        figures_(std::move(figures)) {}

  void count(const Keyframe& keyframe, double length_m) {
    ++figures_.keyframes;
    (keyframe.cut ? figures_.cut_m : figures_.travel_m) += length_m;
    if (!keyframe.cut) {
      cutting_ = false;
      chips_.clear();
      chips_voxels_ = chips_m_ = 0;
      return;
    }
    weigh(keyframe.mill->removed, length_m);
    if (!std::exchange(cutting_, true)) ++figures_.runs;
    figures_.removed += keyframe.mill->removed;
  }

  ToolFigures figures() const {
    ToolFigures figures = figures_;
    figures.removed_m3 = static_cast<double>(figures.removed) * voxel_m3_;
    const double chip_m2 = tool_.max_depth_m * tool_.max_width_m;
    if (figures.cut_m > 0) figures.engagement.mean = figures.removed_m3 / figures.cut_m / chip_m2;
    return figures;
  }

 private:
  /// Over as much path as it takes: in a shorter one a layer of voxels more or less would decide.
  void weigh(std::uint32_t voxels, double length_m) {
    chips_.emplace_back(voxels, length_m);
    chips_voxels_ += voxels;
    chips_m_ += length_m;
    while (chips_.size() > 1 && chips_m_ - chips_.front().second >= window_m_) {
      chips_voxels_ -= chips_.front().first;
      chips_m_ -= chips_.front().second;
      chips_.pop_front();
    }
    if (chips_m_ < window_m_) return;
    const double chip_m2 = chips_voxels_ * voxel_m3_ / chips_m_;
    figures_.engagement.largest =
        std::max(figures_.engagement.largest, chip_m2 / (tool_.max_depth_m * tool_.max_width_m));
  }

  const MillTool& tool_;
  double voxel_m3_, window_m_;
  ToolFigures figures_;
  bool cutting_ = false;
  std::deque<std::pair<std::uint32_t, double>> chips_;  ///< voxels and lengths of the last cuts
  double chips_voxels_ = 0, chips_m_ = 0;
};

}  // namespace sculpt
