#include "core/timing/room/stray_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <sstream>

#include "core/base/error.hpp"
#include "core/collision/body_pairs.hpp"
#include "core/collision/clearance.hpp"
#include "core/collision/margins.hpp"
#include "core/collision/shape/motion_bound.hpp"
#include "core/timing/room/highest_point.hpp"

namespace sculpt {
namespace {

constexpr double share_of_tool_margin = 0.6;

Configuration approach_of(const Chain& chain, const Body& first, const Body& second) {
  return approach_bound(chain, {first.link, first.extent_m}, {second.link, second.extent_m});
}

}  // namespace

StrayBound::StrayBound(const Cell& cell, const Chain& chain, const Grid& grid, double reserve_m)
    : StrayBound(cell, chain, make_bodies(cell, make_tool(cell.tool, grid.voxel_m)), reserve_m) {
  bottom_m_ = grid.origin_m.z();
  tool_m_ = share_of_tool_margin * tool_margin_voxels * grid.voxel_m - reserve_m;
  if (!(reserve_m >= 0) || !(tool_m_ > 0)) {
    std::ostringstream text;
    text << "a reserve of " << 1e6 * reserve_m << " um leaves nothing of the " << 1e6 * (tool_m_ + reserve_m)
         << " um that the tool may stray in this plan: reserve less, or plan with a coarser resolution";
    throw InputError("reserve_invalid", text.str());
  }
  add_others();
}

StrayBound StrayBound::of_links(const Cell& cell, const Chain& chain, double reserve_m) {
  return {cell, chain, make_bodies(cell, make_tool(cell.tool, 1)), reserve_m};
}

StrayBound::StrayBound(const Cell& cell, const Chain& chain, std::vector<Body> bodies, double reserve_m)
    : cell_(cell), chain_(chain), bodies_(std::move(bodies)), reserve_m_(reserve_m) {
  beside_.most = below_.most = Configuration::Zero(chain.dof());
  add_links_and_stock();
  add_link_pairs();
}

void StrayBound::add_links_and_stock() {
  const std::vector<int> group = rigid_groups(cell_.robot);
  const auto group_of = [&](int link) { return group[static_cast<std::size_t>(link)]; };
  const double room_m = share_of_link_margin * link_margin_m - reserve_m_;
  const Vec3 first = cell_.stock_origin_m, last = first + Vec3::Constant(cell_.stock_size_m);
  LinkExtent stock{cell_.stock_link, first.cwiseAbs().cwiseMax(last.cwiseAbs()).norm()};
  const std::span links(bodies_.data(), bodies_.size() - 1);
  if (cell_.has_post)
    for (const Body& body : links)
      if (body.link == stock.link) stock.extent_m = std::max(stock.extent_m, body.extent_m);
  for (const Body& body : links)
    if (group_of(body.link) != group_of(stock.link))
      add_speed(approach_bound(chain_, {body.link, body.extent_m}, stock) / room_m);
}

void StrayBound::add_speed(const Configuration& share) {
  const auto is_below = [](const Configuration& one, const Configuration& other) {
    return (one.array() <= other.array()).all();
  };
  if (std::ranges::any_of(links_, [&](const Configuration& known) { return is_below(share, known); })) return;
  std::erase_if(links_, [&](const Configuration& known) { return is_below(known, share); });
  links_.push_back(share);
}

double StrayBound::links(const Configuration& size) const {
  double most = 0;
  for (const Configuration& share : links_) most = std::max(most, share.dot(size));
  return most;
}

void StrayBound::add_others() {
  const Configuration home = cell_.home(chain_);
  const std::vector<int> group = rigid_groups(cell_.robot);
  const auto group_of = [&](int link) { return group[static_cast<std::size_t>(link)]; };
  const Body& tool = bodies_.back();
  for (std::size_t at = 0; at + 1 < bodies_.size(); ++at) {
    const Body& body = bodies_[at];
    // To those of the stock the tool's own straying counts.
    if (group_of(body.link) == group_of(cell_.stock_link) || group_of(body.link) == group_of(cell_.tool_link)) continue;
    Others& others = stays_below(body, home) ? below_ : beside_;
    others.all.push_back(
        {at, approach_of(chain_, tool, body), motion_bound(chain_, cell_.stock_link, body.link, body.extent_m)});
    others.most = others.most.cwiseMax(others.all.back().speed);
  }
}

void StrayBound::add_link_pairs() {
  std::map<int, std::size_t> body_of;
  const std::size_t whole = bodies_.size() - 1;
  for (std::size_t at = 0; at < whole; ++at) body_of[bodies_[at].link] = at;
  for (const CheckedLinks& checked : find_link_pairs(cell_).checked) {
    const auto first = body_of.find(checked.links.first), second = body_of.find(checked.links.second);
    if (first == body_of.end() || second == body_of.end()) continue;
    std::vector<Body> parts = bodies_;
    for (const BodyPair& pair : pair_bodies(parts, first->second, second->second, checked)) {
      const double room_m = share_of_link_margin * pair.margin_m - reserve_m_;
      if (!(room_m > 0))
        throw InputError("reserve_invalid",
                         "two links are so near each other at home that nothing is left to reserve: reserve less");
      add_speed(approach_of(chain_, parts[pair.first], parts[pair.second]) / room_m);
    }
  }
}

/// Only turned about the z of the stock's frame, seen from there.
bool StrayBound::stays_below(const Body& body, const Configuration& q) const {
  std::vector<Frame> poses;
  chain_.link_poses(q, poses);
  for (const Drive& drive : find_drives(chain_, cell_.stock_link, body.link)) {
    const Joint& joint = cell_.robot.joints[static_cast<std::size_t>(drive.joint)];
    const Vec3 axis = poses[static_cast<std::size_t>(joint.child_link)].linear() * joint.axis;
    if (joint.kind != JointKind::revolute || std::abs(axis.z()) < 1 - 1e-12) return false;
  }
  return highest_point(cell_, body.link, poses) < bottom_m_ - far_m - link_margin_m;
}

void StrayBound::look_along(const PlanPath& path) {
  std::vector<bool>& near = beside_.near;
  near.assign(path.size() / points_a_stretch + 1, !beside_.all.empty());
  if (beside_.all.empty()) return;
  for (std::size_t at = 0; at < near.size(); at += stretches_a_look)
    look_at(path, beside_, at, std::min(at + stretches_a_look, near.size()));
  // A corner counts where its neighbours are, too.
  const std::vector<bool> found = near;
  for (std::size_t at = 0; at < found.size(); ++at)
    if (found[at])
      for (std::size_t beside = at - std::min(at, stretches_beside);
           beside < std::min(at + stretches_beside + 1, found.size()); ++beside)
        near[beside] = true;
}

// Of all edges to the points of the stretches, and two beyond: what a parabola at a point is in is the hull of three.
void StrayBound::look_at(const PlanPath& path, Others& others, std::size_t first, std::size_t end) const {
  const std::size_t from = first == 0 ? 0 : first * points_a_stretch - 2,
                    to = std::min(end * points_a_stretch + 2, path.size());
  Configuration low = path.configuration(std::min(from, path.size() - 1)), high = low;
  for (std::size_t at = from; at < to; ++at) {
    const Eigen::Map<const Configuration> q(path.point(at), static_cast<Eigen::Index>(path.dof()));
    low = low.cwiseMin(q);
    high = high.cwiseMax(q);
  }
  if (is_far(others, low, high)) {
    std::fill(others.near.begin() + static_cast<std::ptrdiff_t>(first),
              others.near.begin() + static_cast<std::ptrdiff_t>(end), false);
    return;
  }
  if (end - first <= 1) return;
  const std::size_t middle = first + (end - first) / 2;
  look_at(path, others, first, middle);
  look_at(path, others, middle, end);
}

// On the straight way from one to the other: in its box, or in those of its halves.
bool StrayBound::is_far_along(const Others& others, const Configuration& from, const Configuration& to,
                              int halvings) const {
  if (is_far(others, from.cwiseMin(to), from.cwiseMax(to))) return true;
  if (halvings == 0) return false;
  const Configuration middle = (from + to) / 2;
  return is_far_along(others, from, middle, halvings - 1) && is_far_along(others, middle, to, halvings - 1);
}

bool StrayBound::is_far(const Others& others, const Configuration& low, const Configuration& high) const {
  const Configuration middle = (low + high) / 2, half = (high - low) / 2;
  std::vector<Frame> poses;
  chain_.link_poses(middle, poses);
  const Body& tool = bodies_.back();
  const Frame& tool_pose = poses[static_cast<std::size_t>(tool.link)];
  return std::ranges::none_of(others.all, [&](const Others::One& other) {
    const Body& body = bodies_[other.body];
    const double reach_m = other.speed.dot(half) + far_m + reserve_m_ + link_margin_m;
    const Frame& pose = poses[static_cast<std::size_t>(body.link)];
    return hull_distance(tool, tool_pose, body, pose) <= reach_m && near_body(tool, tool_pose, body, pose, reach_m);
  });
}

double StrayBound::share(const Others& others, std::size_t point, const Configuration& size, double tool_m) const {
  if (!others.near.empty() && !others.near[point / points_a_stretch]) return others.most.dot(size) / far_m;
  return share(others, size, tool_m);
}

double StrayBound::share(const Others& others, const Configuration& size, double tool_m) const {
  double most = 0;
  for (const Others::One& other : others.all)
    most = std::max(most, std::min(other.speed.dot(size), tool_m + other.own.dot(size)));
  return most / tool_m_;
}

double StrayBound::tool_and_links(std::size_t point, bool above, const Configuration& size) const {
  constexpr double unknown_m = std::numeric_limits<double>::infinity();
  return std::max(share(beside_, point, size, unknown_m),
                  above ? below_.most.dot(size) / far_m : share(below_, size, unknown_m));
}

double StrayBound::tool_and_links(const Configuration& size, double tool_m) const {
  return std::max(share(beside_, size, tool_m), share(below_, size, tool_m));
}

double StrayBound::tool_and_links(const std::pair<Configuration, Configuration>& way, const Configuration& size,
                                  double tool_m) const {
  double most = 0;
  for (const Others* others : {&beside_, &below_}) {
    const double anywhere = share(*others, size, tool_m);
    most = std::max(most, anywhere > 1 && is_far_along(*others, way.first, way.second, max_halvings)
                              ? others->most.dot(size) / far_m
                              : anywhere);
  }
  return most;
}

}  // namespace sculpt
