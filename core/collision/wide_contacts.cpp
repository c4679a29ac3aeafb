#include "core/collision/wide_contacts.hpp"

#include <algorithm>
#include <cmath>

#include "core/collision/shape/motion_bound.hpp"
#include "core/collision/shape/shape_contact.hpp"

namespace sculpt {
namespace {

constexpr double min_share = 0.5;

std::vector<LinkShape> shapes_of(const Robot& robot, int link) {
  std::vector<LinkShape> shapes;
  for (const Shape& shape : robot.links[static_cast<std::size_t>(link)].shapes) shapes.emplace_back(link, shape);
  return shapes;
}

/// How much of the coordinate's travel finds some of the shapes in contact; the others are as at home.
double touching_share(const Cell& cell, const Chain& chain, const CheckedLinks& checked, int coordinate) {
  const std::vector<LinkShape> first = shapes_of(cell.robot, checked.links.first),
                               second = shapes_of(cell.robot, checked.links.second);
  std::vector<ShapeContact> contacts;
  for (const auto& [a, b] : checked.shapes) contacts.emplace_back(chain, first[a], second[b]);
  Configuration q = cell.home(chain);
  const double low = chain.lower()[coordinate], high = chain.upper()[coordinate];
  int touching = 0;
  for (int point = 0; point < travel_points; ++point) {
    q[coordinate] = low + point * (high - low) / (travel_points - 1);
    touching += std::ranges::any_of(contacts, [&](const ShapeContact& contact) { return contact.touch(q); });
  }
  return static_cast<double>(touching) / travel_points;
}

}  // namespace

std::vector<WideContact> find_wide_contacts(const Cell& cell, const std::vector<CheckedLinks>& checked) {
  const Chain chain = cell.chain();
  const std::vector<int> group = rigid_groups(cell.robot);
  const auto groups = [&](int a, int b) {
    return std::minmax(group[static_cast<std::size_t>(a)], group[static_cast<std::size_t>(b)]);
  };
  std::vector<WideContact> wide;
  for (const CheckedLinks& pair : checked) {
    const std::vector<Drive> drives = find_drives(chain, pair.links.first, pair.links.second);
    if (drives.size() != 1) continue;
    const Joint& joint = cell.robot.joints[static_cast<std::size_t>(drives.front().joint)];
    if (groups(joint.parent_link, joint.child_link) != groups(pair.links.first, pair.links.second)) continue;
    const double share = touching_share(cell, chain, pair, drives.front().coordinate);
    if (share >= min_share) wide.push_back({pair.links, drives.front().joint, share});
  }
  return wide;
}

std::string describe(const WideContact& contact, const Robot& robot) {
  return "touch along " + std::to_string(std::lround(100 * contact.share)) + " % of the travel of joint '" +
         robot.joints[static_cast<std::size_t>(contact.joint)].name + "'";
}

}  // namespace sculpt
