#include "core/verify/tool_replay.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {
namespace {

constexpr double mm = 1000;
// A tool that can touch while it moves less than this (in voxels) is reported.
constexpr double too_close_voxels = 0.002;
// Added to every geometry whose absence of contact is taken as proof, over libccd's own error.
constexpr double slack_mm = 0.001;

// Middle of a..b, z along it.
Frame along(const Vec3& a, const Vec3& b) {
  Frame pose = Frame::Identity();
  pose.translation() = (a + b) / 2;
  pose.linear() = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), b - a).toRotationMatrix();
  return pose;
}

}  // namespace

ToolReplay::ToolReplay(const Cell& cell, const Tool& tool, const LinkMotion& motion,
                       const std::vector<SolidBody>& bodies, const StandingVoxels& material, double voxel_mm)
    : cell_(cell),
      motion_(motion),
      material_(material),
      voxel_(voxel_mm),
      ball_(mm * tool.ball_radius_m),
      shank_(mm * tool.shank_radius_m),
      stickout_(mm * tool.stickout_m) {
  const Around around{cell.tool_link, Vec3(0, 0, stickout_ / 2), stickout_ / 2 + std::max(ball_, shank_)};
  const Frame grid(Eigen::Translation3d(mm * cell.stock_origin_m));
  const Around block{cell.stock_link, Vec3::Zero(), -1};
  targets_.push_back({nullptr, grid, cell.stock_link, motion.joints_between(cell.stock_link, cell.tool_link),
                      Vec3::Zero(), Vec3::Constant(material.side_mm()), KeptClearance(motion, around, block)});
  for (const SolidBody& body : bodies) {
    const Around other{body.link, body.pose.translation(), body.radius};
    Target target{&body,
                  body.pose,
                  body.link,
                  motion.joints_between(body.link, cell.tool_link),
                  -body.half,
                  body.half,
                  KeptClearance(motion, around, other)};
    if (!target.joints.empty()) targets_.push_back(std::move(target));  // else it moves with the tool
  }
}

Vec3 ToolReplay::ball_at(const Configuration& q) const {
  return motion_.place(cell_.tool_link, q) * Vec3(0, 0, stickout_);
}

ToolReplay::Line ToolReplay::line_in(const Target& target, const std::vector<Frame>& poses) const {
  const Frame tool = (poses[static_cast<std::size_t>(target.link)] * target.pose).inverse() *
                     poses[static_cast<std::size_t>(cell_.tool_link)];
  return {tool * Vec3(0, 0, stickout_), tool.translation()};
}

ToolReplay::Line ToolReplay::line_in_material(const Configuration& q) const {
  const Frame tool = targets_.front().pose.inverse() * motion_.place(cell_.tool_link, q);
  return {tool * Vec3(0, 0, stickout_), tool.translation()};
}

bool ToolReplay::touches(const Target& target, const fcl::CollisionGeometryd& part, const Frame& pose, const Vec3& low,
                         const Vec3& high) const {
  if (target.body == nullptr) return material_.touches(part, pose, low, high);
  return any_part(*target.body, 0, [&](const fcl::CollisionGeometryd& solid, const Frame& at) {
    return solids_touch(part, pose, solid, at);
  });
}

// The ball grown by `grow`, all the way between two places.
bool ToolReplay::ball_meets(const Target& target, const Vec3& from, const Vec3& to, double grow) const {
  const double radius = ball_ + grow;
  const Vec3 low = from.cwiseMin(to).array() - radius, high = from.cwiseMax(to).array() + radius;
  if ((low.array() > target.high.array()).any() || (high.array() < target.low.array()).any()) return false;
  const double way = (to - from).norm();
  if (way < 1e-6) return touches(target, fcl::Sphered(radius + way), Frame(Eigen::Translation3d(from)), low, high);
  return touches(target, fcl::Capsuled(radius, way), along(from, to), low, high);
}

bool ToolReplay::shank_meets(const Target& target, const Line& line, double grow, double longer) const {
  const double radius = shank_ + grow;
  const Vec3 low = line.ball.cwiseMin(line.top).array() - radius - longer,
             high = line.ball.cwiseMax(line.top).array() + radius + longer;
  if ((low.array() > target.high.array()).any() || (high.array() < target.low.array()).any()) return false;
  const fcl::Cylinderd part(radius, (line.top - line.ball).norm() + 2 * longer);
  return touches(target, part, along(line.ball, line.top), low, high);
}

// Two covers of everything that the shank passes: a box along it, tight when it moves sideways or endwise without
// turning, and a thicker cylinder in the middle, tight when it hardly moves. It meets nothing if either does not.
bool ToolReplay::swept_shank_meets(const Target& target, const Sweep& sweep) const {
  const Line &start = sweep.start, &end = sweep.end;
  const double radius = shank_ + sweep.sagitta + slack_mm;
  const Vec3 low = start.ball.cwiseMin(end.ball).cwiseMin(start.top).cwiseMin(end.top).array() - radius;
  const Vec3 high = start.ball.cwiseMax(end.ball).cwiseMax(start.top).cwiseMax(end.top).array() + radius;
  if ((low.array() > target.high.array()).any() || (high.array() < target.low.array()).any()) return false;

  const Line middle{(start.ball + end.ball) / 2, (start.top + end.top) / 2};
  const Vec3 axis = (middle.top - middle.ball).normalized();
  Vec3 aside = end.ball - start.ball + end.top - start.top;
  aside -= axis * axis.dot(aside);
  aside = aside.norm() > 1e-6 * voxel_ ? Vec3(aside.normalized()) : axis.unitOrthogonal();
  Frame turn = Frame::Identity();
  turn.linear() << aside, axis.cross(aside), axis;
  fcl::AABBd box;
  for (const Vec3& corner : {start.ball, end.ball, start.top, end.top}) box += Vec3(turn.linear().transpose() * corner);
  const Frame pose = turn * Eigen::Translation3d(box.center());
  const Vec3 sides = box.max_ - box.min_ + Vec3::Constant(2 * radius);
  if (!touches(target, fcl::Boxd(sides), pose, low, high)) return false;

  const double ball_way = (end.ball - start.ball).norm() / 2 + sweep.sagitta,
               top_way = (end.top - start.top).norm() / 2 + sweep.sagitta;
  const double length = (middle.top - middle.ball).norm();
  const double way = std::max(ball_way, top_way), tilt = (ball_way + top_way) / length;
  if (way > voxel_ || tilt > 0.5) return true;
  // Points off the axis move along it when the shank tilts: asin(tilt) < 1.1 tilt up to 0.5.
  return shank_meets(target, middle, way + slack_mm, way + 1.1 * tilt * shank_ + slack_mm);
}

ToolReplay::Finding ToolReplay::settle(const Task& task, const std::vector<Frame>& start,
                                       const std::vector<Frame>& middle, const std::vector<Frame>& end,
                                       const Configuration& steps) const {
  const Target& target = *task.target;
  Sweep sweep{line_in(target, start), line_in(target, end), line_in(target, middle), 0};
  const Frame& tool = middle[static_cast<std::size_t>(cell_.tool_link)];
  sweep.sagitta = sagitta_bound(target.joints, middle, steps, tool * Vec3(0, 0, stickout_));
  double way = (sweep.end.ball - sweep.start.ball).norm() / 2;
  if (task.shank) {
    sweep.sagitta = std::max(sweep.sagitta, sagitta_bound(target.joints, middle, steps, tool.translation()));
    way = std::max(way, (sweep.end.top - sweep.start.top).norm() / 2);
    if (!swept_shank_meets(target, sweep)) return Finding::free;
    if (shank_meets(target, sweep.middle, 0, 0)) return Finding::touches;
  } else {
    if (!ball_meets(target, sweep.start.ball, sweep.end.ball, sweep.sagitta + slack_mm)) return Finding::free;
    if (ball_meets(target, sweep.middle.ball, sweep.middle.ball, 0)) return Finding::touches;
  }
  return way + sweep.sagitta < too_close_voxels * voxel_ ? Finding::too_close : Finding::unknown;
}

void ToolReplay::certify(const JointMotion& motion, double from, double to, const std::vector<Frame>& start,
                         const std::vector<Frame>& end, const std::vector<Task>& open,
                         const OnContact& on_contact) const {
  const double t = (from + to) / 2;
  std::vector<Frame> middle;
  motion_.place_links(motion.at(t), middle);
  std::vector<Task> left;
  for (const Task& task : open) {
    const Finding finding = settle(task, start, middle, end, (to - from) / 2 * motion.step);
    if (finding == Finding::free) continue;
    if (finding == Finding::unknown) {
      left.push_back(task);
      continue;
    }
    const SolidBody* body = task.target->body;
    const std::string names =
        std::string("the tool's ") + (task.shank ? "shank" : "ball") + " and " +
        (body == nullptr ? "the material" : "link " + cell_.robot.links[static_cast<std::size_t>(body->link)].name);
    on_contact(names + (finding == Finding::touches ? " touch" : " are too close to prove that they do not touch"), t);
  }
  if (left.empty()) return;
  certify(motion, from, t, start, middle, left, on_contact);
  certify(motion, t, to, middle, end, left, on_contact);
}

// What still stands of the run lies beyond the plane between the voxel being cut and the next one.
bool ToolReplay::keeps_off_the_rest(const JointMotion& motion, Voxel first, Voxel last, double tolerance_mm) const {
  const Target& material = targets_.front();
  const auto point = [](Voxel v) { return Vec3(v.i, v.j, v.k); };
  const int parts = l1(first, last) + 1;
  const Vec3 way = point(last - first) / (parts - 1);
  std::vector<Frame> poses;
  motion_.place_links(motion.at(0.5), poses);
  const Frame tool = poses[static_cast<std::size_t>(cell_.tool_link)];
  const auto sagitta_at = [&](const Vec3& at) { return sagitta_bound(material.joints, poses, motion.step / 2, at); };
  const double whole_sagitta = std::max(sagitta_at(tool * Vec3(0, 0, stickout_)), sagitta_at(tool.translation()));
  const double room =
      whole_sagitta / (parts * parts) + slack_mm;  // a part has the same second derivative, and 1/n the time

  Line before = line_in_material(motion.from);
  for (int part = 0; part < parts; ++part) {
    const Line after = line_in_material(motion.at(static_cast<double>(part + 1) / parts));
    const Vec3 centre = voxel_ * (point(first) + part * way + Vec3::Constant(0.5));
    if (!((after.ball - centre).norm() <= tolerance_mm)) return false;
    const double ball = std::max(way.dot(before.ball), way.dot(after.ball));
    const double shank = std::max({ball, way.dot(before.top), way.dot(after.top)});
    const double reach = std::max(ball + ball_, shank + shank_) + room;
    if (part + 1 < parts && !(reach <= way.dot(centre) + voxel_ / 2)) return false;
    before = after;
  }
  return true;
}

void ToolReplay::look_ahead(const TrajectoryPiece& piece, bool in_limits) {
  for (Target& target : targets_) target.clearance.forget();
  if (!in_limits) {
    ahead_ = OpenItems(piece, targets_.size());
    return;
  }
  ahead_ = OpenItems(motion_, piece, targets_.size(),
                     [this](std::size_t at, const std::vector<Frame>& poses, const Configuration& half) {
                       const Target& target = targets_[at];
                       return target.body == nullptr ||
                              comes_near(target, poses, target.clearance.approach(poses, half) + slack_mm);
                     });
}

// Of a capsule around ball and shank.
bool ToolReplay::comes_near(const Target& target, const std::vector<Frame>& poses, double grow) const {
  const Line line = line_in(target, poses);
  return ball_meets(target, line.ball, line.top, std::max(ball_, shank_) - ball_ + grow);
}

// Where the motion ended.
void ToolReplay::renew_clearance(Target& target, const std::vector<Frame>& poses, const JointMotion& motion) const {
  KeptClearance& kept = target.clearance;
  kept.move_anchor(motion.at(1), poses);
  const double travel = kept.approach(motion);
  for (double times : {256, 64, 16, 4}) {
    if (comes_near(target, poses, times * travel + slack_mm)) continue;
    kept.prove(times * travel);
    return;
  }
}

// Of the links that the tool is looked at from: all, or just the one that carries the material.
void ToolReplay::place_ends(const Configuration& q, bool all, std::vector<Frame>& poses) const {
  if (all) return motion_.place_links(q, poses);
  poses.resize(cell_.robot.links.size());
  for (const int link : {cell_.stock_link, cell_.tool_link})
    poses[static_cast<std::size_t>(link)] = motion_.place(link, q);
}

void ToolReplay::replay(std::size_t keyframe, const JointMotion& motion, const OnContact& on_contact) {
  if (motion.step.isZero(0)) return;
  std::vector<Task> open;
  std::vector<Target*> uncovered;
  for (const std::size_t at : ahead_.of(keyframe)) {
    Target& target = targets_[at];
    const bool is_link = target.body != nullptr;
    if (is_link && (!target.clearance.moved_by(motion) || target.clearance.covers(motion))) continue;
    if (is_link) uncovered.push_back(&target);
    open.push_back({&target, false});
    if (shank_ > 0 && stickout_ > 0) open.push_back({&target, true});
  }
  std::vector<Frame> start, end;
  place_ends(motion.from, !uncovered.empty(), start);
  place_ends(motion.at(1), !uncovered.empty(), end);
  certify(motion, 0, 1, start, end, open, on_contact);
  for (Target* target : uncovered) renew_clearance(*target, end, motion);
}

}  // namespace sculpt
