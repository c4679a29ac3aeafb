// Plan + law -> verdict: does the motion keep the cell's limits, the feed and the path? Shares no code with what made
// it.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "core/base/watch.hpp"
#include "core/cell/cell.hpp"
#include "core/law/law_file.hpp"

namespace sculpt {

struct MotionFinding {
  std::uint64_t keyframe = 0;  ///< from 1
  std::string sentence;
};

struct MotionVerdict {
  std::uint64_t faults = 0;             ///< all, also those not listed
  std::vector<MotionFinding> findings;  ///< the first 100
  std::uint64_t pieces = 0, samples = 0;
  double total_s = 0;
  /// Largest shares of the limits that the motion comes to.
  double velocity = 0, acceleration = 0, jerk = 0, feed_m_s = 0, rapid_m_s = 0;
  /// How far from the plan's edges it comes at the samples: on cuts ball and shank's end (voxel edges); always how much
  /// nearer two links, or one and the stock, may be to each other than there (m).
  double ball_voxels = 0, shank_voxels = 0, links_m = 0;
  /// Of milling tools instead: points of the cutter from where the straight ways of the tip would have them.
  double cutter_m = 0;
};

struct MotionCheck {
  double samples_hz = 1000;
  double max_ball_voxels = 0.04, max_shank_voxels = 0.1, max_links_m = 0.15e-3;  ///< more is a fault
};

/// Velocities and accelerations are looked at on every piece, exactly: they are means of those before the moving
/// average. Jerk is at most the change of acceleration over a window. At samples: velocity, acceleration, jerk, the
/// ball's speed, how far ball and shank are from where the path is at the mean of the window, and how much nearer links
/// may be to each other and to the stock than there. Throws InputError `trajectory_invalid`, `limits_missing`;
/// Cancelled.
MotionVerdict check_motion(std::istream& plan, const LawFile& law, const Cell& cell, const Watch& watch,
                           const MotionCheck& check = {});

}  // namespace sculpt
