#include "core/motion/line.hpp"

#include "core/trajectory/quantum.hpp"

namespace sculpt {
namespace {

/// Joint steps longer than this are split: they would leave the line by too much to be worth certifying.
constexpr double max_joint_step = 0.4;
/// Lines shorter than this (voxel edges) are not split further.
constexpr double min_piece_voxels = 0.12;

struct Tracker {
  const Scene& scene;
  Vec3 axis;
  std::vector<Configuration> path;  // starts with the configuration to go on from
  Contact hit = Contact::none;

  bool track(const Vec3& start, const Vec3& end) {
    const Configuration& from = path.back();
    const auto to = solve_rounded(scene.chain(), {end, axis}, from);
    if (to && (*to - from).cwiseAbs().maxCoeff() <= max_joint_step) {
      hit = scene.certify(from, *to);
      if (hit == Contact::none) {
        path.push_back(*to);
        return true;
      }
      if (scene.contact_at(*to) != Contact::none) return false;  // however short the steps, they lead there
    }
    if ((end - start).norm() < 2 * min_piece_voxels * scene.grid().voxel_m) return false;
    const Vec3 middle = (start + end) / 2;
    return track(start, middle) && track(middle, end);
  }
};

}  // namespace

std::optional<Configuration> solve_rounded(const Chain& chain, const IkGoal& goal, const Configuration& seed) {
  const auto q = solve_ik(chain, goal, seed);
  if (!q) return {};
  const Configuration stored = rounded(*q, chain.lower(), chain.upper());
  if (!chain.within_limits(stored)) return {};
  return stored;
}

std::optional<std::vector<Configuration>> track_line(const Scene& scene, const Configuration& from, const Vec3& ball_m,
                                                     const Vec3& axis, Contact* contact) {
  Tracker tracker{scene, axis, {from}};
  const bool done = tracker.track(scene.chain().tool_pose(from).ball_m, ball_m);
  if (contact != nullptr) *contact = tracker.hit;
  if (!done) return {};
  tracker.path.erase(tracker.path.begin());
  return std::move(tracker.path);
}

}  // namespace sculpt
