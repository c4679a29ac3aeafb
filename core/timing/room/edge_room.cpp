#include "core/timing/room/edge_room.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/collision/link_pairs.hpp"
#include "core/timing/room/highest_point.hpp"

namespace sculpt {
namespace {

constexpr double margin = 0.003;     // voxel edges, for the replay to prove
constexpr double max_off = 0.02;     // of the middle of a cell
constexpr double hover = 0.4;        // room above all that stands
constexpr int max_columns = 1024;    // that a way above all is looked for over
constexpr double touching_m = 1e-6;  // the table touches the stock
constexpr double max_stray = 0.04;   // off the line, sagitta included

Voxel cell_of(const Vec3& point) {
  return {static_cast<int>(std::floor(point.x())), static_cast<int>(std::floor(point.y())),
          static_cast<int>(std::floor(point.z()))};
}
Vec3 middle_of(Voxel cell) {
  return Vec3(cell.i, cell.j, cell.k) + Vec3::Constant(0.5);
}

std::size_t nearest_direction(const Vec3& axis) {
  std::size_t best = 0;
  for (std::size_t at = 0; at < face_steps.size(); ++at)
    if (axis.dot(Vec3(face_steps[at].i, face_steps[at].j, face_steps[at].k)) >
        axis.dot(Vec3(face_steps[best].i, face_steps[best].j, face_steps[best].k)))
      best = at;
  return best;
}

/// In the stock's frame, of all that stands still there.
double highest_beside(const Cell& cell, const Chain& chain, const Configuration& q) {
  const std::vector<int> group = rigid_groups(cell.robot);
  std::vector<Frame> poses;
  chain.link_poses(q, poses);
  double most = -std::numeric_limits<double>::infinity();
  for (int link = 0; link < static_cast<int>(group.size()); ++link)
    if (group[static_cast<std::size_t>(link)] == group[static_cast<std::size_t>(cell.stock_link)])
      most = std::max(most, highest_point(cell, link, poses));
  return most;
}

}  // namespace

/// In voxel edges: ball and shank's end at the beginning and at the end.
struct EdgeRoomFinder::Ends {
  std::array<Vec3, 2> ball, top;
  std::size_t direction;
  EdgeSagitta sagitta;  ///< m
};

EdgeRoomFinder::EdgeRoomFinder(const PlanPath& path, const Cell& cell, const Chain& chain, double reserve_m)
    : path_(path),
      grid_(path.header().grid),
      ball_radius_(path.header().tool.ball_radius_m / grid_.voxel_m),
      shank_radius_(path.header().tool.shank_radius_m / grid_.voxel_m),
      stickout_m_(path.header().tool.stickout_m),
      tolerance_(std::min(max_stray, path.header().tolerance_m / grid_.voxel_m)),
      reserve_(reserve_m / grid_.voxel_m),
      all_below_(highest_beside(cell, chain, path.configuration(0)) <= grid_.origin_m.z() + touching_m),
      columns_(grid_.n) {}

EdgeRoom EdgeRoomFinder::go_to(std::size_t point, const EdgeSagitta& sagitta, const EdgePlaces& places) {
  if (!all_below_) return {};
  Ends ends;
  for (std::size_t at = 0; at < 2; ++at) {
    const ToolPose& pose = (at == 0 ? places.begin : places.end).pose;
    ends.ball[at] = (pose.ball_m - grid_.origin_m) / grid_.voxel_m;
    ends.top[at] = ends.ball[at] + stickout_m_ / grid_.voxel_m * pose.axis;
  }
  ends.direction = nearest_direction(places.begin.pose.axis + places.end.pose.axis);
  ends.sagitta = sagitta;
  const int voxels = path_.edge_to(point).voxels;
  EdgeRoom room;
  if (face_steps[ends.direction].k >= 0) {
    room = in_columns(voxels, ends);
    if (!room.known && voxels == 0) room = above_all(ends);
  }
  if (voxels > 0) {
    Voxel voxel = path_.voxel_of(point, 0);
    const Voxel step = voxels > 1 ? path_.voxel_of(point, 1) - voxel : Voxel{};
    for (int at = 0; at < voxels; ++at, voxel = voxel + step) columns_.remove(voxel);
  }
  return room;
}

EdgeRoom EdgeRoomFinder::in_columns(int voxels, const Ends& ends) {
  const Voxel from = cell_of(ends.ball[0]), to = cell_of(ends.ball[1]), gap = to - from;
  if ((gap.i != 0) + (gap.j != 0) + (gap.k != 0) > 1 || from.k < 0 || to.k < 0) return {};
  const Voxel axis = face_steps[ends.direction];
  const Vec3 along(axis.i, axis.j, axis.k);
  double ball_off = 0, top_off = 0;
  for (std::size_t end = 0; end < 2; ++end) {
    const Vec3 middle = middle_of(end == 0 ? from : to), beside = ends.top[end] - middle;
    ball_off = std::max(ball_off, (ends.ball[end] - middle).norm());
    top_off = std::max(top_off, (beside - along * along.dot(beside)).norm());
  }
  if (ball_off > max_off) return {};
  const Voxel step = sign(gap);
  const int cells = l1(from, to);
  for (int at = 0; at <= cells; ++at)
    if (!columns_.is_open(from + step * at, ends.direction, at > cells - voxels)) return {};
  const double h = grid_.voxel_m;
  const auto room = [&](double radius, double off, double most, double sagitta) {
    return EndRoom{h * (std::min(most, 0.5 - radius - margin) - off - reserve_), sagitta, ends.sagitta.more};
  };
  return {true, room(ball_radius_, ball_off, tolerance_, ends.sagitta.ball),
          room(shank_radius_, std::max(ball_off, top_off), 0.5, ends.sagitta.top)};
}

EdgeRoom EdgeRoomFinder::above_all(const Ends& ends) {
  Vec3 low = ends.ball[0], high = low;
  for (const auto* points : {&ends.ball, &ends.top})
    for (const Vec3& point : *points) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
  const double sagitta = (std::max(ends.sagitta.ball, ends.sagitta.top) + ends.sagitta.more) / grid_.voxel_m;
  const Voxel axis = face_steps[ends.direction];
  const Vec3 along(axis.i, axis.j, axis.k);
  const double around = std::max(ball_radius_, shank_radius_) + hover + margin + reserve_ + sagitta;
  low.array() -= around;
  high.array() += around;
  if (low.z() < 0) return {};
  if (!columns_.are_open(cell_of(low), cell_of(high), ends.direction, max_columns)) return {};
  const double room = grid_.voxel_m * hover;
  return {true, {room, 0, 0}, {room, 0, 0}};
}

}  // namespace sculpt
