#include "core/place/arm/stand_contacts.hpp"

#include <algorithm>
#include <memory>

#include "core/cell/link_tree.hpp"
#include "core/collision/body_pairs.hpp"
#include "core/collision/clearance.hpp"
#include "core/collision/margins.hpp"

namespace sculpt {
namespace {

constexpr double touching_m = 1e-4;  // nearer to each other, things that stand still count as touching

}  // namespace

Body make_block(const Eigen::AlignedBox3d& box_m) {
  Shape shape;
  shape.kind = ShapeKind::box;
  shape.pose.translation() = box_m.center();
  shape.sides_m = box_m.sizes();
  return {-1, false, {{std::make_shared<const ShapeTree>(make_tree(shape)), 0}}};
}

StandContacts::StandContacts(const Cell& cell, int joint, const Grid& grid)
    : bodies_(make_bodies(cell, make_tool(cell.tool, grid.voxel_m, grid.n))) {
  const std::vector<int> group = rigid_groups(cell.robot);
  const auto group_of = [&](const Body& body) { return group[static_cast<std::size_t>(body.link)]; };
  const int stock_group = group[static_cast<std::size_t>(cell.stock_link)];
  const int tool_group = group[static_cast<std::size_t>(cell.tool_link)];
  const std::size_t whole = bodies_.size();
  for (std::size_t at = 0; at < whole; ++at) {
    if (!bodies_[at].tool && group_of(bodies_[at]) != stock_group) beside_stock_.push_back(at);
    if (bodies_[at].tool)
      for (std::size_t other = 0; other < whole; ++other)
        if (!bodies_[other].tool && group_of(bodies_[other]) != tool_group)
          pairs_.push_back({other, at, tool_margin_voxels * grid.voxel_m, {}});
  }
  const auto body_of = [&](int link) {
    return static_cast<std::size_t>(std::find_if(bodies_.begin(), bodies_.begin() + static_cast<std::ptrdiff_t>(whole),
                                                 [&](const Body& body) { return body.link == link && !body.tool; }) -
                                    bodies_.begin());
  };
  for (const CheckedLinks& checked : find_link_pairs(cell).checked)
    for (const auto& [first, second, margin_m] :
         pair_bodies(bodies_, body_of(checked.links.first), body_of(checked.links.second), checked))
      pairs_.push_back({first, second, margin_m, {}});
  find_cells(cell, joint);
  find_standing(cell, joint, grid, whole);
}

void StandContacts::find_cells(const Cell& cell, int joint) {
  const Chain chain = cell.chain();
  for (Pair& pair : pairs_) {
    const Body &first = bodies_[pair.first], &second = bodies_[pair.second];
    if (carries(cell.robot, joint, first.link) != carries(cell.robot, joint, second.link)) continue;
    auto cells = std::make_unique<FreeCells>(chain, first, second, pair.margin_m);
    if (cells->is_usable()) pair.cells = std::move(cells);
  }
}

/// What touches where the cell stands is meant to.
void StandContacts::find_standing(const Cell& cell, int joint, const Grid& grid, std::size_t whole) {
  const std::vector<int> group = rigid_groups(cell.robot);
  const auto group_of = [&](int link) { return group[static_cast<std::size_t>(link)]; };
  std::vector<Frame> poses;
  const Chain chain = cell.chain();
  chain.link_poses(cell.home(chain), poses);
  const auto pose = [&](std::size_t body) -> const Frame& {
    return poses[static_cast<std::size_t>(bodies_[body].link)];
  };
  const Body block = make_block({grid.origin_m, grid.origin_m + Vec3::Constant(grid.n * grid.voxel_m)});
  for (std::size_t a = 0; a < whole; ++a) {
    const int link = bodies_[a].link;
    if (bodies_[a].tool) continue;
    if (group_of(link) == group_of(cell.stock_link) &&
        carries(cell.robot, joint, link) != carries(cell.robot, joint, cell.stock_link) &&
        !near_body(bodies_[a], pose(a), block, Frame::Identity(), touching_m))
      beside_block_.push_back(a);
    for (std::size_t b = a + 1; b < whole; ++b)
      if (!bodies_[b].tool && group_of(link) == group_of(bodies_[b].link) &&
          carries(cell.robot, joint, link) != carries(cell.robot, joint, bodies_[b].link) &&
          !near_body(bodies_[a], pose(a), bodies_[b], pose(b), touching_m))
        standing_.push_back({a, b, touching_m, {}});
  }
}

bool StandContacts::is_blocked(const std::vector<Frame>& poses, const Body& block) const {
  const auto pose = [&](const Body& body) -> const Frame& { return poses[static_cast<std::size_t>(body.link)]; };
  return std::ranges::any_of(standing_,
                             [&](const Pair& pair) {
                               const Body &first = bodies_[pair.first], &second = bodies_[pair.second];
                               return near_body(first, pose(first), second, pose(second), pair.margin_m);
                             }) ||
         std::ranges::any_of(beside_block_, [&](std::size_t body) {
           return near_body(bodies_[body], pose(bodies_[body]), block, Frame::Identity(), touching_m);
         });
}

StandContact StandContacts::at(const Chain& chain, const Configuration& q, const std::vector<Frame>& poses,
                               const Body& block, std::size_t& last) const {
  const auto pose = [&](const Body& body) -> const Frame& { return poses[static_cast<std::size_t>(body.link)]; };
  const auto touches = [&](const Pair& pair) {
    if (pair.cells && pair.cells->is_free(chain, q)) return false;
    const Body &first = bodies_[pair.first], &second = bodies_[pair.second];
    return near_body(first, pose(first), second, pose(second), pair.margin_m);
  };
  if (last < pairs_.size() && touches(pairs_[last])) return StandContact::links;
  for (std::size_t at = 0; at < pairs_.size(); ++at)
    if (at != last && touches(pairs_[at])) {
      last = at;
      return StandContact::links;
    }
  for (const std::size_t body : beside_stock_)
    if (near_body(bodies_[body], pose(bodies_[body]), block, Frame::Identity(), link_margin_m))
      return StandContact::stock;
  return StandContact::none;
}

bool StandContacts::tool_touches(const std::vector<Frame>& poses, const Body& block) const {
  return std::ranges::any_of(bodies_, [&](const Body& body) {
    return body.tool &&
           near_body(body, poses[static_cast<std::size_t>(body.link)], block, Frame::Identity(), link_margin_m);
  });
}

}  // namespace sculpt
