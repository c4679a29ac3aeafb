// A step of a trajectory.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/base/frame.hpp"
#include "core/material/voxel.hpp"

namespace sculpt {

/// No tip is farther from the stock's origin along an axis (m): what is computed of it in whole numbers stays exact.
inline constexpr double max_tip_m = 10;

/// Of a plan with milling tools, what a keyframe is about besides the joints: a change of tools, or where the tip is
/// meant to be. A cut goes straight from the tip of the keyframe before it, in the same direction, to this one.
struct MillStep {
  std::array<std::int64_t, 3> tip{};  ///< quanta (1e-7 m), stock frame
  int direction = -1;                 ///< of the axis: one of the header's; none where the tool is only taken along
  int tool = -1;                      ///< change to this one of the header's, at rest
  std::uint32_t removed = 0;          ///< voxels that a cut removes

  bool is_placed() const { return direction >= 0; }
  bool is_change() const { return tool >= 0; }
};

/// Linear joint motion from the previous keyframe (the first one starts at home) to q. A cut of a thin tool removes the
/// straight run of voxels first..last (along one axis), the m-th of n at path parameter m/n; one of a milling tool what
/// its cutter sweeps; a move removes nothing.
struct Keyframe {
  Configuration q;
  bool cut = false;
  Voxel first, last;
  std::optional<MillStep> mill = {};
};

/// Number of voxels that a cut removes.
int run_length(const Keyframe& keyframe);

}  // namespace sculpt
