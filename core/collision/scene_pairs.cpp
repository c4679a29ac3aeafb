// Which bodies of a scene must stay apart, and what is known of them once and for all.
#include <map>

#include "core/collision/body_pairs.hpp"
#include "core/collision/margins.hpp"
#include "core/collision/scene_bodies.hpp"
#include "core/collision/shape/one_joint.hpp"

namespace sculpt {
namespace {

/// Parts of a joint's range that move less than this are not split further (m).
constexpr double finest_part_m = 1e-3;
/// Of a joint's range, to find pairs that touch before it is tried to prove that they do not.
constexpr int places_tried = 16;

}  // namespace

SceneBodies::Mover SceneBodies::make_mover(int body, int from_link) const {
  const Body& mover = bodies[static_cast<std::size_t>(body)];
  return {body, motion_bound(chain, from_link, mover.link, mover.extent_m), turn_bound(chain, from_link, mover.link),
          find_drives(chain, from_link, mover.link)};
}

Configuration SceneBodies::grid_speed_from(int link) const {
  const Vec3 first = grid.origin_m, last = grid.origin_m + Vec3::Constant(grid.n * grid.voxel_m);
  return motion_bound(chain, link, chain.stock_link(), first.cwiseAbs().cwiseMax(last.cwiseAbs()).norm());
}

void SceneBodies::add_pair(int a, int b, double margin_m) {
  const Body& first = bodies[static_cast<std::size_t>(a)];
  const Body& second = bodies[static_cast<std::size_t>(b)];
  Pair pair{a, b, margin_m, {make_mover(a, second.link), make_mover(b, first.link)}, {}};
  pair.of_links = !first.tool && !second.tool;
  if (!pair.movers[0].drives.empty()) pairs.push_back(std::move(pair));
}

void SceneBodies::add_pairs(const Cell& cell) {
  const std::vector<int> group = rigid_groups(cell.robot);
  const int stock_group = group[static_cast<std::size_t>(cell.stock_link)];
  const int tool_group = group[static_cast<std::size_t>(cell.tool_link)];
  LinkPairs found = find_link_pairs(cell);
  unchecked = std::move(found.unchecked);
  std::map<LinkPair, const CheckedLinks*> checked;
  for (const CheckedLinks& links : found.checked) checked[links.links] = &links;
  struct Place {
    int link, group;
    bool tool;
  };
  std::vector<Place> places;  // of whole bodies: parts of them are added on the way
  for (const Body& body : bodies) places.push_back({body.link, group[static_cast<std::size_t>(body.link)], body.tool});
  const int count = static_cast<int>(places.size());
  for (int a = 0; a < count; ++a) {
    const Place& first = places[static_cast<std::size_t>(a)];
    const bool by_maps = cell.tool.is_guided_by_maps() && first.group == tool_group;
    if (!first.tool && first.group != stock_group && !by_maps)
      pairs.push_back({a, -1, link_margin_m, {make_mover(a, cell.stock_link)}, grid_speed_from(first.link)});
    for (int b = a + 1; b < count; ++b) {
      const Place& second = places[static_cast<std::size_t>(b)];
      if (second.tool) {
        const std::size_t before = pairs.size();
        if (first.group != tool_group) add_pair(a, b, tool_margin_voxels * grid.voxel_m);
        if (pairs.size() > before) pairs.back().tool_and_fixed = first.group == stock_group;
      } else if (const auto at = checked.find({first.link, second.link}); at != checked.end()) {
        for (const BodyPair& pair :
             pair_bodies(bodies, static_cast<std::size_t>(a), static_cast<std::size_t>(b), *at->second))
          add_pair(static_cast<int>(pair.first), static_cast<int>(pair.second), pair.margin_m);
      }
    }
  }
  for (int a = 0; a < count && !cell.tool.is_guided_by_maps(); ++a)
    if (const Place& place = places[static_cast<std::size_t>(a)]; !place.tool && place.group == stock_group)
      fixed.push_back(&bodies[static_cast<std::size_t>(a)]);
}

/// Finds the pairs that one joint moves and that it can move as it likes, or in parts of its range. Material only
/// shrinks, so that stays true.
void SceneBodies::find_free_ranges() {
  for (Pair& pair : pairs) {
    if (pair.joints() != 1) continue;
    pair.never_touch = never_touch(pair);
    if (pair.never_touch || !pair.of_links) continue;
    pair.movers[0].speed.maxCoeff(&pair.coordinate);
    add_free_ranges(pair, chain.lower()[pair.coordinate], chain.upper()[pair.coordinate]);
  }
}

/// Of a pair that one joint moves: wherever it stands?
bool SceneBodies::never_touch(const Pair& pair) const {
  const Mover& mover = pair.movers[0];
  if (pair.second < 0 || mover.drives.size() != 1)
    return certify_links(chain.lower(), chain.upper() - chain.lower(), 0.5, 0.5, {&pair}) == Contact::none;
  const Drive& drive = mover.drives[0];
  const Body& moves = bodies[static_cast<std::size_t>(pair.first)];
  const Body& other = bodies[static_cast<std::size_t>(pair.second)];
  const double low = chain.lower()[drive.coordinate], high = chain.upper()[drive.coordinate];
  std::vector<Frame> at;
  Configuration q = chain.lower();
  for (int place = 0; place <= places_tried; ++place) {
    q[drive.coordinate] = low + (high - low) * place / places_tried;
    count_check();
    chain.link_poses(q, at);
    if (near(pair, at, pair.margin_m)) return false;
  }
  q[drive.coordinate] = low;
  chain.link_poses(q, at);
  const Frame to_other = at[static_cast<std::size_t>(other.link)].inverse();
  const Joint& joint = chain.robot().joints[static_cast<std::size_t>(drive.joint)];
  const Frame joint_at = to_other * at[static_cast<std::size_t>(joint.child_link)];
  return stay_apart(moves, other,
                    {to_other * at[static_cast<std::size_t>(moves.link)], joint.kind != JointKind::prismatic,
                     joint_at.linear() * joint.axis, joint_at.translation(), drive.rate * (high - low)},
                    pair.margin_m);
}

void SceneBodies::add_free_ranges(Pair& pair, double low, double high) const {
  Configuration q = chain.lower(), half = Configuration::Zero(chain.dof());
  q[pair.coordinate] = (low + high) / 2;
  half[pair.coordinate] = (high - low) / 2;
  std::vector<Frame> at;
  count_check();
  chain.link_poses(q, at);
  const double motion = pair.motion(half);
  if (!near(pair, at, motion + pair.margin_m)) {
    auto& ranges = pair.free_ranges;
    if (!ranges.empty() && ranges.back().second == low)
      ranges.back().second = high;
    else
      ranges.emplace_back(low, high);
  } else if (motion > finest_part_m) {
    add_free_ranges(pair, low, q[pair.coordinate]);
    add_free_ranges(pair, q[pair.coordinate], high);
  }
}

}  // namespace sculpt
