// How far a configuration is off the path of a plan. Internal to verify/.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "core/verify/robot/link_motion.hpp"
#include "core/verify/robot/solid_body.hpp"
#include "core/verify/timed/law_replay.hpp"

namespace sculpt {

/// Where the plan's edges have ball and links, for a joint configuration beside them.
class PathBeside {
 public:
  PathBeside(const Cell& cell, const std::vector<std::string>& joints, double stickout_m, const LawReplay& replay)
      : motion_(cell.robot, numbers_of(cell, joints), cell.rest, cell.stock_link),
        bodies_(make_solid_bodies(cell.robot)),
        tool_link_(static_cast<std::size_t>(cell.tool_link)),
        stickout_mm_(1000 * stickout_m),
        replay_(replay) {}

  Vec3 ball(const Configuration& q) {
    motion_.place_links(q, poses_);
    return poses_[tool_link_] * Vec3(0, 0, stickout_mm_);
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
    const Vec3 end(0, 0, stickout_mm_);
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
  /// Of the edge that was looked at last.
  std::uint64_t keyframe() const { return replay_.numbers()[std::min(edge_ + 1, replay_.numbers().size() - 1)]; }

 private:
  static std::vector<int> numbers_of(const Cell& cell, const std::vector<std::string>& joints) {
    std::vector<int> numbers;
    for (const std::string& name : joints) numbers.push_back(cell.robot.find_joint(name));
    return numbers;
  }

  LinkMotion motion_;
  std::vector<SolidBody> bodies_;
  std::size_t tool_link_;
  double stickout_mm_;
  const LawReplay& replay_;
  std::size_t edge_ = 0;
  std::vector<Frame> poses_, on_path_;
};

}  // namespace sculpt
