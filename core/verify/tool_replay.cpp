#include "core/verify/tool_replay.hpp"

#include <algorithm>
#include <cmath>

#include "core/verify/findings/slack.hpp"

namespace sculpt {
namespace {

// A tool that can touch while it moves less than this (in voxels) is reported.
constexpr double too_close_voxels = 0.002;

// Middle of a..b, z along it.
Frame along(const Vec3& a, const Vec3& b) {
  Frame pose = Frame::Identity();
  pose.translation() = (a + b) / 2;
  pose.linear() = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), b - a).toRotationMatrix();
  return pose;
}

}  // namespace

ToolReplay::ToolReplay(const Cell& cell, const Tool& tool, const LinkMotion& motion,
                       const std::vector<SolidBody>& bodies, const StandingVoxels& material)
    : cell_(cell),
      motion_(motion),
      material_(material),
      voxel_(material.voxel_mm()),
      ball_(mm * tool.ball_radius_m),
      shank_(mm * tool.shank_radius_m),
      stickout_(mm * tool.stickout_m) {
  const Around around{cell.tool_link, Vec3(0, 0, stickout_ / 2), stickout_ / 2 + std::max(ball_, shank_)};
  const Frame grid(Eigen::Translation3d(mm * cell.stock_origin_m));
  add_target(motion,
             {nullptr, 0, grid.inverse(), cell.stock_link, grid, Vec3::Zero(), Vec3::Constant(material.side_mm()),
              ApproachBound(motion, around, {cell.stock_link, Vec3::Zero(), -1})});
  for (const SolidBody& body : bodies) {
    if (motion.joints_between(body.link, cell.tool_link).empty()) continue;  // it moves with the tool
    add_target(motion, {&body, 0, body.pose.inverse(), body.link, body.pose, -body.half, body.half,
                        ApproachBound(motion, around, {body.link, body.pose.translation(), body.radius})});
  }
}

void ToolReplay::add_target(const LinkMotion& motion, Target target) {
  for (target.view = 0; target.view < views_.size(); ++target.view) {
    const LinkChain still = motion.chain(views_[target.view].link, target.link);
    if (!still.is_rigid()) continue;
    target.from_view = (still.rigid() * target.pose).inverse();
    break;
  }
  if (target.view == views_.size()) views_.push_back({target.link, motion.chain(target.link, cell_.tool_link), {}, {}});
  targets_.push_back(std::move(target));
}

Vec3 ToolReplay::ball_at(const Configuration& q) {
  Placed placed;
  place(q, views_[targets_.front().view], placed);
  return placed.line.ball;
}

void ToolReplay::place(const Configuration& q, const View& view, Placed& placed) const {
  placed.q = q;
  view.chain.place(q, placed.place);
  placed.line = {placed.place.link * Vec3(0, 0, stickout_), placed.place.link.translation()};
}

void ToolReplay::place_ends(const JointMotion& motion, View& view) const {
  const auto is_at = [](const Placed& placed, const Configuration& q) {
    return placed.q.size() == q.size() && placed.q == q;
  };
  if (!is_at(view.before, motion.from)) {
    std::swap(view.before, view.after);
    if (!is_at(view.before, motion.from)) place(motion.from, view, view.before);
  }
  if (!is_at(view.after, motion.to)) place(motion.to, view, view.after);
}

ToolReplay::Line ToolReplay::seen_from(const Target& target, const Line& line) const {
  return {target.from_view * line.ball, target.from_view * line.top};
}

// Of any point of the line.
double ToolReplay::sagitta(const LinkChain& chain, const Placed& start, const Placed& end,
                           const Configuration& step) const {
  return chain.sagitta(start.place, end.place, step, Vec3(0, 0, stickout_), Vec3::Zero());
}

// Whether this can be told from the ends of the motion.
bool ToolReplay::is_clear(const Target& target, const JointMotion& motion) const {
  const View& view = views_[target.view];
  const Sweep sweep{seen_from(target, view.before.line), seen_from(target, view.after.line),
                    sagitta(view.chain, view.before, view.after, motion.step)};
  return !ball_meets(target, sweep.start.ball, sweep.end.ball, sweep.sagitta + contact_slack_mm) &&
         !(has_shank() && swept_shank_meets(target, sweep));
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
  const double radius = shank_ + sweep.sagitta + contact_slack_mm;
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
  return shank_meets(target, middle, way + contact_slack_mm, way + 1.1 * tilt * shank_ + contact_slack_mm);
}

ToolReplay::Finding ToolReplay::settle(const Task& task, const Placed& start, const Placed& middle, const Placed& end,
                                       const Configuration& step) const {
  const Target& target = *task.target;
  const Sweep sweep{seen_from(target, start.line), seen_from(target, end.line),
                    sagitta(views_[target.view].chain, start, end, step)};
  double way = (sweep.end.ball - sweep.start.ball).norm() / 2;
  const Line half_way = seen_from(target, middle.line);
  if (task.shank) {
    way = std::max(way, (sweep.end.top - sweep.start.top).norm() / 2);
    if (!swept_shank_meets(target, sweep)) return Finding::free;
    if (shank_meets(target, half_way, 0, 0)) return Finding::touches;
  } else {
    if (!ball_meets(target, sweep.start.ball, sweep.end.ball, sweep.sagitta + contact_slack_mm)) return Finding::free;
    if (ball_meets(target, half_way.ball, half_way.ball, 0)) return Finding::touches;
  }
  return way + sweep.sagitta < too_close_voxels * voxel_ ? Finding::too_close : Finding::unknown;
}

void ToolReplay::certify(const Stretch& stretch, const std::vector<Task>& open, const OnContact& on_contact) const {
  const double t = (stretch.from + stretch.to) / 2;
  Placed middle;
  place(stretch.motion.at(t), stretch.view, middle);
  std::vector<Task> left;
  for (const Task& task : open) {
    const Finding finding =
        settle(task, stretch.start, middle, stretch.end, (stretch.to - stretch.from) * stretch.motion.step);
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
  certify({stretch.motion, stretch.view, stretch.from, t, stretch.start, middle}, left, on_contact);
  certify({stretch.motion, stretch.view, t, stretch.to, middle, stretch.end}, left, on_contact);
}

// What still stands of the run lies beyond the plane between the voxel being cut and the next one.
bool ToolReplay::keeps_off_the_rest(const JointMotion& motion, Voxel first, Voxel last, double tolerance_mm) {
  const Target& material = targets_.front();
  View& view = views_[material.view];
  place_ends(motion, view);
  const auto point = [](Voxel v) { return Vec3(v.i, v.j, v.k); };
  const int parts = l1(first, last) + 1;
  const Vec3 way = point(last - first) / (parts - 1);
  const auto stays_off = [&](int part, const Line& before, const Line& after, double off, double room) {
    const Vec3 centre = voxel_ * (point(first) + part * way + Vec3::Constant(0.5));
    if (!((after.ball - centre).norm() + off <= tolerance_mm)) return false;
    const double ball = std::max(way.dot(before.ball), way.dot(after.ball));
    const double shank = std::max({ball, way.dot(before.top), way.dot(after.top)});
    const double reach = std::max(ball + ball_, shank + shank_) + room;
    return part + 1 == parts || reach <= way.dot(centre) + voxel_ / 2;
  };
  const double stray = sagitta(view.chain, view.before, view.after, motion.step);
  const Line first_line = seen_from(material, view.before.line), last_line = seen_from(material, view.after.line);
  const auto between = [&](int part) {
    const double t = static_cast<double>(part) / parts;
    return Line{first_line.ball + t * (last_line.ball - first_line.ball),
                first_line.top + t * (last_line.top - first_line.top)};
  };
  int part = 0;
  while (part < parts && stays_off(part, between(part), between(part + 1), stray, stray + contact_slack_mm)) ++part;
  if (part == parts) return true;

  // A part has the same second derivative, and 1/n the time.
  const double room = stray / (parts * parts) + contact_slack_mm;
  Line before = first_line;
  Placed placed;
  for (part = 0; part < parts; ++part) {
    place(motion.at(static_cast<double>(part + 1) / parts), view, placed);
    const Line after = seen_from(material, placed.line);
    if (!stays_off(part, before, after, 0, room)) return false;
    before = after;
  }
  return true;
}

void ToolReplay::look_ahead(const TrajectoryPiece& piece, bool prove_ahead) {
  if (!prove_ahead) {
    ahead_ = OpenItems(piece, targets_.size());
    return;
  }
  ahead_ = OpenItems(motion_, piece, targets_.size(), [this](std::size_t at, const OpenItems::Box& box) {
    const Target& target = targets_[at];
    return target.body == nullptr ||
           comes_near(target, box.poses, target.approach.at(box.poses, box.half) + contact_slack_mm);
  });
}

// Of a capsule around ball and shank.
bool ToolReplay::comes_near(const Target& target, const std::vector<Frame>& poses, double grow) const {
  const Frame tool = (poses[static_cast<std::size_t>(target.link)] * target.pose).inverse() *
                     poses[static_cast<std::size_t>(cell_.tool_link)];
  return ball_meets(target, tool * Vec3(0, 0, stickout_), tool.translation(), std::max(ball_, shank_) - ball_ + grow);
}

void ToolReplay::replay(std::size_t keyframe, const JointMotion& motion, const OnContact& on_contact) {
  if (motion.step.isZero(0)) return;
  std::vector<std::vector<Task>> open(views_.size());
  for (const std::size_t at : ahead_.of(keyframe)) {
    const Target& target = targets_[at];
    View& view = views_[target.view];
    if (!view.chain.moved_by(motion.step)) continue;
    place_ends(motion, view);
    if (!material_.thorough() && is_clear(target, motion)) continue;
    open[target.view].push_back({&target, false});
    if (has_shank()) open[target.view].push_back({&target, true});
  }
  for (std::size_t at = 0; at < views_.size(); ++at) {
    const View& view = views_[at];
    if (!open[at].empty()) certify({motion, view, 0, 1, view.before, view.after}, open[at], on_contact);
  }
}

}  // namespace sculpt
