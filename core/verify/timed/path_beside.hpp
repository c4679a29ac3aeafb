// How far a configuration is off the path of a plan. Internal to verify/.
#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/verify/robot/link_motion.hpp"
#include "core/verify/robot/solid_body.hpp"
#include "core/verify/timed/law_replay.hpp"

namespace sculpt {

/// Where the plan's edges have ball and links, for a joint configuration beside them.
class PathBeside {
 public:
  PathBeside(const Cell& cell, const TrajectoryHeader& header, const LawReplay& replay);

  /// Ball or tip, of the tool that is in the spindle on the edge that was looked at last.
  Vec3 ball(const Configuration& q);

  /// Millimetres that ball and shank's end are off where the path is at r, and that any two bodies which must not
  /// touch, or a body and the stock's cube, may be nearer to each other than there. Seen from the same link, whichever
  /// it is, that is no more than what the corners of both boxes are displaced: seen from the stock, the root or one of
  /// the two, where it is least. Not looked for where it is no more than `known`.
  struct Off {
    double ball = 0, shank = 0, links = 0;
  };
  Off off(const Configuration& q, double gone, double known);

  /// Of a milling tool that cuts: how far a point of its cutter is from where the straight ways of its tip would have
  /// it (mm), at most, on the edge that was looked at last or those before and behind it.
  double cutter_off(const Configuration& q);
  /// The tool on the edge that was looked at last, of a plan with milling tools.
  const MillTool* milling() const;
  /// Of the edge that was looked at last.
  std::uint64_t keyframe() const { return replay_.numbers()[std::min(edge_ + 1, replay_.numbers().size() - 1)]; }

 private:
  /// A box on a link.
  struct Thing {
    std::size_t link;
    Frame pose;  ///< in the link
    Vec3 half;
  };

  double stickout_mm() const { return 1000 * (header_.mill ? milling()->stickout_m : header_.tool.stickout_m); }
  double nearer(double known);
  double displaced(const Thing& thing, std::size_t seen_from) const;

  LinkMotion motion_;
  std::vector<Thing> things_;
  std::vector<std::pair<std::size_t, std::size_t>> pairs_;  // of things that must not touch
  std::size_t tool_link_, stock_link_, root_;
  const TrajectoryHeader& header_;
  const LawReplay& replay_;
  std::size_t edge_ = 0;
  std::vector<Frame> poses_, on_path_;
  std::vector<double> by_stock_, by_root_;  // of things: how far they are displaced, seen from there
};

}  // namespace sculpt
