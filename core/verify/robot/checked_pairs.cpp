#include "core/verify/robot/checked_pairs.hpp"

#include <algorithm>
#include <optional>

#include "core/verify/robot/bearing.hpp"
#include "core/verify/robot/joint_range.hpp"

namespace sculpt {
namespace {

bool lists(const std::vector<LinkPair>& pairs, int a, int b) {
  return std::find(pairs.begin(), pairs.end(), LinkPair(std::minmax(a, b))) != pairs.end();
}

Configuration home_of(const Cell& cell, const std::vector<int>& joints) {
  Configuration home(static_cast<Eigen::Index>(joints.size()));
  for (std::size_t at = 0; at < joints.size(); ++at)
    home[static_cast<Eigen::Index>(at)] = cell.rest[static_cast<std::size_t>(joints[at])];
  return home;
}

class Chooser {
 public:
  Chooser(const Cell& cell, const std::vector<int>& joints, const LinkMotion& motion,
          const std::vector<SolidBody>& bodies)
      : cell_(cell),
        motion_(motion),
        bodies_(bodies),
        limits_(joint_limits(cell.robot, joints)),
        at_home_(home_of(cell, joints)) {
    motion.place_links(at_home_, home_);
  }

  bool touch_at_home(const SolidBody& a, const SolidBody& b) const { return touch(a, b, home_); }

  /// Why two that touch at home may do so; empty if nothing shows that.
  std::string excuse(const SolidBody& a, const SolidBody& b) const {
    const std::vector<MovingJoint> joints = motion_.joints_between(a.link, b.link);
    if (joints.size() == 1 && share_bearing(a, b, joints.front())) return "neighbours that touch at their joint";
    if (overlap_everywhere(a, b, motion_, limits_)) return "proved to overlap in every configuration";
    return {};
  }

  bool move(const SolidBody& a, const SolidBody& b) const { return !motion_.joints_between(a.link, b.link).empty(); }

 private:
  bool share_bearing(const SolidBody& a, const SolidBody& b, const MovingJoint& joint) const {
    return meet_at_joint(a, b, joint, home_) || touch_in_bearing(a, b, joint) ||
           (!joint.turns && slide_on_each_other(a, b, joint.coordinate));
  }

  // Do they touch along half of the travel?
  bool slide_on_each_other(const SolidBody& a, const SolidBody& b, int coordinate) const {
    constexpr int looks = 33;
    Configuration q = at_home_;
    std::vector<Frame> poses;
    int touching = 0;
    for (int look = 0; look < looks; ++look) {
      q[coordinate] = limits_.middle[coordinate] + limits_.half[coordinate] * (2.0 * look / (looks - 1) - 1);
      motion_.place_links(q, poses);
      touching += touch(a, b, poses);
    }
    return 2 * touching >= looks;
  }

  // Do the two touch inside another body of theirs that meets its neighbour at the joint?
  bool touch_in_bearing(const SolidBody& a, const SolidBody& b, const MovingJoint& joint) const {
    const std::optional<Vec3> contact = contact_point(a, b, home_);
    return contact && std::any_of(bodies_.begin(), bodies_.end(), [&](const SolidBody& around) {
             if (&around == &a || &around == &b || !holds_point(around, home_, *contact)) return false;
             return (around.link == a.link && meets_any_of(b.link, around, joint)) ||
                    (around.link == b.link && meets_any_of(a.link, around, joint));
           });
  }

  bool meets_any_of(int link, const SolidBody& body, const MovingJoint& joint) const {
    return std::any_of(bodies_.begin(), bodies_.end(), [&](const SolidBody& other) {
      return other.link == link && meet_at_joint(body, other, joint, home_);
    });
  }

  const Cell& cell_;
  const LinkMotion& motion_;
  const std::vector<SolidBody>& bodies_;
  const JointRange limits_;
  const Configuration at_home_;
  std::vector<Frame> home_;
};

}  // namespace

CheckedPairs choose_pairs(const Cell& cell, const std::vector<int>& joints, const LinkMotion& motion,
                          const std::vector<SolidBody>& bodies) {
  const Chooser chooser(cell, joints, motion, bodies);
  const std::vector<Link>& links = cell.robot.links;
  CheckedPairs pairs;
  for (std::size_t a = 0; a < bodies.size(); ++a)
    for (std::size_t b = a + 1; b < bodies.size(); ++b) {
      const SolidBody &first = bodies[a], &second = bodies[b];
      if (!chooser.move(first, second)) continue;  // as the cell stands: not the plan's matter
      const std::string &name = links[static_cast<std::size_t>(first.link)].name,
                        &other = links[static_cast<std::size_t>(second.link)].name;
      const bool ignored = lists(cell.ignore_pairs, first.link, second.link);
      const bool in_doubt =
          !ignored && !lists(cell.check_pairs, first.link, second.link) && chooser.touch_at_home(first, second);
      const std::string why = ignored ? "the cell's ignore_pairs" : in_doubt ? chooser.excuse(first, second) : "";
      if (!why.empty()) {
        pairs.exempt.push_back({name, other, why});
        continue;
      }
      pairs.checked.emplace_back(&first, &second);
      if (in_doubt) pairs.contacts.emplace_back(std::minmax(first.link, second.link));
    }
  const auto sort = [](auto& list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  };
  sort(pairs.exempt);
  sort(pairs.contacts);
  return pairs;
}

}  // namespace sculpt
