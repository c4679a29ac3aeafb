// Keyframes -> the figures of a tool.
#pragma once

#include <utility>

#include "core/cell/milling/mill_tool.hpp"
#include "core/mill/tool_figures.hpp"
#include "core/trajectory/keyframe.hpp"

namespace sculpt {

/// Counts what passes by.
class ToolMeter {
 public:
  ToolMeter(const MillTool& tool, double voxel_m3) : tool_(tool), voxel_m3_(voxel_m3) { figures_.name = tool.name; }

  void count(const Keyframe& keyframe, double length_m) {
    ++figures_.keyframes;
    (keyframe.cut ? figures_.cut_m : figures_.travel_m) += length_m;
    if (!keyframe.cut) {
      cutting_ = false;
      return;
    }
    if (!std::exchange(cutting_, true)) ++figures_.runs;
    figures_.removed += keyframe.mill->removed;
  }

  ToolFigures take() {
    figures_.removed_m3 = static_cast<double>(figures_.removed) * voxel_m3_;
    const double chip_m2 = tool_.max_depth_m * tool_.max_width_m;
    if (figures_.cut_m > 0) figures_.engagement.mean = figures_.removed_m3 / figures_.cut_m / chip_m2;
    return figures_;
  }

 private:
  const MillTool& tool_;
  double voxel_m3_;
  ToolFigures figures_;
  bool cutting_ = false;
};

}  // namespace sculpt
