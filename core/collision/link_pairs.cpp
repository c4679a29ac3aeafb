#include "core/collision/link_pairs.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "core/collision/shape/motion_bound.hpp"
#include "core/collision/shape/shape_contact.hpp"

namespace sculpt {
namespace {

/// Gaps at home that are told apart (m).
constexpr std::array gaps_m{touching_m, 5e-5, 1e-4, 2e-4};

const char* const bearing = "neighbours that touch at the joint";
const char* const always = "touch in every configuration";
const char* const wherever_tried = "touch at home and in every configuration tried";
const char* const ignored = "ignore_pairs";

bool holds(const std::vector<LinkPair>& pairs, const LinkPair& pair) {
  return std::binary_search(pairs.begin(), pairs.end(), pair);
}

/// What is known of a cell while its pairs are looked at.
class PairFinder {
 public:
  explicit PairFinder(const Cell& cell)
      : cell_(cell), chain_(cell.chain()), home_(cell.home(chain_)), group_(rigid_groups(cell.robot)) {
    for (const Joint& joint : cell.robot.joints)
      joined_.insert(std::minmax(group(joint.parent_link), group(joint.child_link)));
    for (int link = 0; link < static_cast<int>(cell.robot.links.size()); ++link) {
      shapes_.emplace_back();
      for (const Shape& shape : cell.robot.links[static_cast<std::size_t>(link)].shapes)
        shapes_.back().emplace_back(link, shape);
    }
  }

  /// Adds what is found out about two links to `found`.
  void look_at(const LinkPair& links, LinkPairs& found) const {
    const auto& first = shapes(links.first);
    const auto& second = shapes(links.second);
    if (group(links.first) == group(links.second) || first.empty() || second.empty()) return;
    if (find_drives(chain_, links.first, links.second).empty()) return;
    if (holds(cell_.ignore_pairs, links)) {
      found.unchecked.push_back({links, ignored});
      return;
    }
    CheckedLinks checked{links, {}, gaps_m.back()};
    std::set<std::string> reasons;
    for (std::size_t a = 0; a < first.size(); ++a)
      for (std::size_t b = 0; b < second.size(); ++b) {
        const ShapeContact contact(chain_, first[a], second[b]);
        const std::string why = why_unchecked(contact, first[a], second[b]);
        if (!why.empty()) {
          reasons.insert(why);
          continue;
        }
        checked.shapes.emplace_back(a, b);
        checked.gap_m = std::min(checked.gap_m, gap_at_home(contact));
      }
    for (const std::string& why : reasons) found.unchecked.push_back({links, why});
    if (!checked.shapes.empty()) found.checked.push_back(std::move(checked));
  }

 private:
  int group(int link) const { return group_[static_cast<std::size_t>(link)]; }
  const std::vector<LinkShape>& shapes(int link) const { return shapes_[static_cast<std::size_t>(link)]; }

  /// Empty if the two must be kept apart.
  std::string why_unchecked(const ShapeContact& contact, const LinkShape& first, const LinkShape& second) const {
    if (holds(cell_.check_pairs, {first.link, second.link}) || !contact.touch(home_)) return {};
    if (joined_.count(std::minmax(group(first.link), group(second.link))) > 0)
      return is_bearing(contact, first, second) ? bearing : "";
    if (contact.always_touch(home_)) return always;
    return contact.come_apart(home_) ? "" : wherever_tried;
  }

  /// Of shapes on either side of one joint that touch at home.
  bool is_bearing(const ShapeContact& contact, const LinkShape& first, const LinkShape& second) const {
    const Drive drive = find_drives(chain_, first.link, second.link).front();
    const Joint& joint = cell_.robot.joints[static_cast<std::size_t>(drive.joint)];
    if (joint.kind == JointKind::revolute && at_axis(joint, first) && at_axis(joint, second)) return true;
    int touching = 0;
    Configuration q = home_;
    for (int point = 0; point < travel_points; ++point) {
      q[drive.coordinate] =
          chain_.lower()[drive.coordinate] +
          point * (chain_.upper()[drive.coordinate] - chain_.lower()[drive.coordinate]) / (travel_points - 1);
      touching += contact.touch(q);
    }
    return 2 * touching >= travel_points;
  }

  /// Is the joint's axis no farther from the shape than half of the shape's smallest side?
  bool at_axis(const Joint& joint, const LinkShape& shape) const {
    std::vector<Frame> at;
    chain_.link_poses(home_, at);
    const Frame& pose = at[static_cast<std::size_t>(shape.link)];
    const Frame& turns = at[static_cast<std::size_t>(joint.child_link)];
    Shape rod;
    rod.kind = ShapeKind::cylinder;
    rod.radius_m = shape.half_thickness();
    rod.length_m = 2 * ((turns.inverse() * pose * shape.box.translation()).norm() + shape.half_sides.norm());
    rod.pose = turns * Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), joint.axis);
    return fcl_touch(*make_fcl_geometry(rod, 0), to_fcl(rod.pose), *shape.geometry, to_fcl(pose * shape.shape->pose));
  }

  /// The largest of `gaps_m` that the two surely have; 0 if they touch.
  double gap_at_home(const ShapeContact& contact) const {
    double gap = 0;
    for (double reach : gaps_m) {
      if (contact.touch(home_, reach)) break;
      gap = reach;
    }
    return gap;
  }

  const Cell& cell_;
  const Chain chain_;
  const Configuration home_;
  const std::vector<int> group_;
  std::vector<std::vector<LinkShape>> shapes_;  // of each link
  std::set<std::pair<int, int>> joined_;        // groups across one joint
};

}  // namespace

std::vector<int> rigid_groups(const Robot& robot) {
  std::vector<int> group(robot.links.size());
  for (std::size_t link = 0; link < group.size(); ++link) group[link] = static_cast<int>(link);
  for (const Joint& joint : robot.joints)
    if (joint.kind == JointKind::fixed)
      group[static_cast<std::size_t>(joint.child_link)] = group[static_cast<std::size_t>(joint.parent_link)];
  return group;
}

LinkPairs find_link_pairs(const Cell& cell) {
  const PairFinder finder(cell);
  const int links = static_cast<int>(cell.robot.links.size());
  LinkPairs found;
  for (int first = 0; first < links; ++first)
    for (int second = first + 1; second < links; ++second) finder.look_at({first, second}, found);
  return found;
}

}  // namespace sculpt
