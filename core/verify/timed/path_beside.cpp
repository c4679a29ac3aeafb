#include "core/verify/timed/path_beside.hpp"

#include <algorithm>
#include <cmath>

#include "core/verify/findings/slack.hpp"
#include "core/verify/robot/checked_pairs.hpp"

namespace sculpt {
namespace {

constexpr std::size_t edges_beside = 200;  // that a window of time may hold

std::vector<int> numbers_of(const Cell& cell, const std::vector<std::string>& joints) {
  std::vector<int> numbers;
  numbers.reserve(joints.size());
  for (const std::string& name : joints) numbers.push_back(cell.robot.find_joint(name));
  return numbers;
}

std::size_t root_of(const Robot& robot) {
  const auto is_root = [](const Link& link) { return link.parent_joint < 0; };
  return static_cast<std::size_t>(std::ranges::find_if(robot.links, is_root) - robot.links.begin());
}

}  // namespace

PathBeside::PathBeside(const Cell& cell, const TrajectoryHeader& header, const LawReplay& replay)
    : motion_(cell.robot, numbers_of(cell, header.joints), cell.rest, cell.stock_link),
      tool_link_(static_cast<std::size_t>(cell.tool_link)),
      stock_link_(static_cast<std::size_t>(cell.stock_link)),
      root_(root_of(cell.robot)),
      header_(header),
      replay_(replay) {
  const std::vector<SolidBody> bodies = make_solid_bodies(cell.robot);
  for (const SolidBody& body : bodies) things_.push_back({static_cast<std::size_t>(body.link), body.pose, body.half});
  const Vec3 half = Vec3::Constant(mm * header.grid.n * header.grid.voxel_m / 2);
  things_.push_back({stock_link_, Frame(Eigen::Translation3d(mm * header.grid.origin_m + half)), half});
  for (std::size_t body = 0; body < bodies.size(); ++body)
    if (!motion_.joints_between(cell.stock_link, bodies[body].link).empty()) pairs_.emplace_back(body, bodies.size());
  for (const auto& [first, second] : choose_pairs(cell, numbers_of(cell, header.joints), motion_, bodies).checked)
    pairs_.emplace_back(first - bodies.data(), second - bodies.data());
}

Vec3 PathBeside::ball(const Configuration& q) {
  motion_.place_links(q, poses_);
  return poses_[tool_link_] * Vec3(0, 0, stickout_mm());
}

PathBeside::Off PathBeside::off(const Configuration& q, double gone, double known) {
  const auto& lengths = replay_.gone();
  while (edge_ + 2 < lengths.size() && lengths[edge_ + 1] < gone) ++edge_;
  while (edge_ > 0 && lengths[edge_] > gone) --edge_;
  if (lengths.size() < 2) return {};
  const double share = std::clamp((gone - lengths[edge_]) / (lengths[edge_ + 1] - lengths[edge_]), 0.0, 1.0);
  const Configuration there = replay_.points()[edge_] + share * (replay_.points()[edge_ + 1] - replay_.points()[edge_]);
  if ((q - there).cwiseAbs().maxCoeff() < 1e-12) return {};
  motion_.place_links(q, poses_);
  motion_.place_links(there, on_path_);
  const Vec3 end(0, 0, stickout_mm());
  return {(poses_[tool_link_] * end - on_path_[tool_link_] * end).norm(),
          (poses_[tool_link_].translation() - on_path_[tool_link_].translation()).norm(), nearer(known)};
}

double PathBeside::nearer(double known) {
  by_stock_.clear();
  by_root_.clear();
  for (const Thing& thing : things_) by_stock_.push_back(displaced(thing, stock_link_));
  for (const auto& [a, b] : pairs_) {
    double least = by_stock_[a] + by_stock_[b];
    if (least <= known) continue;
    if (by_root_.empty())
      for (const Thing& thing : things_) by_root_.push_back(displaced(thing, root_));
    least = std::min(least, by_root_[a] + by_root_[b]);
    if (least > known) least = std::min(least, displaced(things_[a], things_[b].link));
    if (least > known) least = std::min(least, displaced(things_[b], things_[a].link));
    known = std::max(known, least);
  }
  return known;
}

/// The farthest of its corners.
double PathBeside::displaced(const Thing& thing, std::size_t seen_from) const {
  const Frame here = poses_[seen_from].inverse() * poses_[thing.link] * thing.pose,
              path = on_path_[seen_from].inverse() * on_path_[thing.link] * thing.pose;
  const Eigen::Matrix<double, 3, 4> change = here.affine() - path.affine();
  double most = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 at = thing.half.cwiseProduct(Vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1));
    most = std::max(most, (change.leftCols<3>() * at + change.col(3)).squaredNorm());
  }
  return std::sqrt(most);
}

double PathBeside::cutter_off(const Configuration& q) {
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

const MillTool* PathBeside::milling() const {
  if (!header_.mill) return nullptr;
  const std::size_t at = std::min(edge_ + 1, replay_.mill().size() - 1);
  return &header_.mill->tools[static_cast<std::size_t>(replay_.mill()[at].tool)];
}

}  // namespace sculpt
