// How far a configuration is off the path of a plan. Internal to verify/.
#pragma once

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "core/verify/robot/link_motion.hpp"
#include "core/verify/robot/solid_body.hpp"
#include "core/verify/timed/law_replay.hpp"

namespace sculpt {

/// Where the plan's edges have ball and links, for a joint configuration beside them.
class PathBeside {
 public:
  PathBeside(const Cell& cell, const TrajectoryHeader& header, const LawReplay& replay)
      : motion_(cell.robot, numbers_of(cell, header.joints), cell.rest, cell.stock_link),
        bodies_(make_solid_bodies(cell.robot)),
        tool_link_(static_cast<std::size_t>(cell.tool_link)),
        header_(header),
        replay_(replay) {}

  /// Ball or tip, of the tool that is in the spindle on the edge that was looked at last.
  Vec3 ball(const Configuration& q) {
    motion_.place_links(q, poses_);
    return poses_[tool_link_] * Vec3(0, 0, stickout_mm());
  }

  /// Millimetres that ball, shank's end and the corners of any body's box are off where the path is at r.
  struct Off {
    double ball = 0, shank = 0, links = 0;
  };
  Off off(const Configuration& q, double gone) {
    const auto& lengths = replay_.gone();
    while (edge_ + 2 < lengths.size() && lengths[edge_ + 1] < gone) ++edge_;
    while (edge_ > 0 && lengths[edge_] > gone) --edge_;
    if (lengths.size() < 2) return {};
    const double share = std::clamp((gone - lengths[edge_]) / (lengths[edge_ + 1] - lengths[edge_]), 0.0, 1.0);
    const Configuration there =
        replay_.points()[edge_] + share * (replay_.points()[edge_ + 1] - replay_.points()[edge_]);
    if ((q - there).cwiseAbs().maxCoeff() < 1e-12) return {};
    motion_.place_links(q, poses_);
    motion_.place_links(there, on_path_);
    Off off;
    const Vec3 end(0, 0, stickout_mm());
    off.ball = (poses_[tool_link_] * end - on_path_[tool_link_] * end).norm();
    off.shank = (poses_[tool_link_].translation() - on_path_[tool_link_].translation()).norm();
    for (const SolidBody& body : bodies_) {
      const Frame here = poses_[static_cast<std::size_t>(body.link)] * body.pose,
                  path = on_path_[static_cast<std::size_t>(body.link)] * body.pose;
      for (int corner = 0; corner < 8; ++corner) {
        const Vec3 at = body.half.cwiseProduct(Vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1));
        off.links = std::max(off.links, (here * at - path * at).norm());
      }
    }
    return off;
  }
  /// Of a milling tool that cuts: how far a point of its cutter is from where the straight ways of its tip would have
  /// it (mm), at most, on the edge that was looked at last or those before and behind it.
  double cutter_off(const Configuration& q) {
    motion_.place_links(q, poses_);
    const MillTool& tool = *milling();
    const double length = stickout_mm(), high = 1000 * tool.cutter.flute_m, radius = 1000 * tool.cutter.radius_m;
    const Vec3 tip = poses_[tool_link_] * Vec3(0, 0, length), top = poses_[tool_link_].translation();
    double least = std::numeric_limits<double>::infinity();
    const auto look_at = [&](std::size_t point) {
      const LawReplay::MillPoint &from = replay_.mill()[point - 1], &to = replay_.mill()[point];
      if (!to.cut || from.direction != to.direction || to.direction < 0) return false;
      const Vec3 way = to.tip_mm - from.tip_mm;
      const double share =
          way.squaredNorm() > 0 ? std::clamp((tip - from.tip_mm).dot(way) / way.squaredNorm(), 0.0, 1.0) : 0;
      const auto& direction = header_.mill->directions[static_cast<std::size_t>(to.direction)];
      const Vec3 axis = Vec3(direction[0], direction[1], direction[2]).normalized(), there = from.tip_mm + share * way;
      // Along the axis what is off goes evenly from the one end to the other; across it the tool leans.
      const Vec3 low = tip - there, lean = (top - there - length * axis - low) / length;
      least = std::min(least, std::max(low.norm(), (low + high * lean).norm()) + radius * lean.norm());
      return true;
    };
    const std::size_t at = edge_ + 1, last = replay_.mill().size() - 1;
    look_at(at);
    for (std::size_t step = 1; step <= edges_beside && at > step && look_at(at - step); ++step) continue;
    for (std::size_t step = 1; step <= edges_beside && at + step <= last && look_at(at + step); ++step) continue;
    return least;
  }
  /// The tool on the edge that was looked at last, of a plan with milling tools.
  const MillTool* milling() const {
    if (!header_.mill) return nullptr;
    const std::size_t at = std::min(edge_ + 1, replay_.mill().size() - 1);
    return &header_.mill->tools[static_cast<std::size_t>(replay_.mill()[at].tool)];
  }
  /// Of the edge that was looked at last.
  std::uint64_t keyframe() const { return replay_.numbers()[std::min(edge_ + 1, replay_.numbers().size() - 1)]; }

 private:
  static constexpr std::size_t edges_beside = 200;  // that a window of time may hold

  double stickout_mm() const { return 1000 * (header_.mill ? milling()->stickout_m : header_.tool.stickout_m); }
  static std::vector<int> numbers_of(const Cell& cell, const std::vector<std::string>& joints) {
    std::vector<int> numbers;
    for (const std::string& name : joints) numbers.push_back(cell.robot.find_joint(name));
    return numbers;
  }

  LinkMotion motion_;
  std::vector<SolidBody> bodies_;
  std::size_t tool_link_;
  const TrajectoryHeader& header_;
  const LawReplay& replay_;
  std::size_t edge_ = 0;
  std::vector<Frame> poses_, on_path_;
};

}  // namespace sculpt
