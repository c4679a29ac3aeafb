#include "core/timing/edge.hpp"

#include <algorithm>
#include <cmath>

#include "core/collision/shape/motion_bound.hpp"

namespace sculpt {
namespace {

constexpr double finest_turn = 0.05;  // rad: longer edges are looked at in parts
constexpr int max_parts = 256;

}  // namespace

ToolRates::ToolRates(const Chain& the_chain)
    : chain(the_chain),
      travel(motion_bound(chain, chain.stock_link(), chain.tool_link(), chain.stickout_m())),
      turn(chain.turn_rates()),
      stickout_m(chain.stickout_m()) {}

void ToolPlace::put(const ToolRates& rates, const Configuration& q) {
  pose = rates.chain.tool_pose(q, jacobian);
}

/// The ball's velocity by r leaves the line between its values at the ends of a part of length p by no more than p^2 /
/// 8 times the third derivative of the ball's place.
PathEdge make_edge(const ToolRates& rates, const JointRates& joints, const Configuration& start,
                   const Configuration& end, EdgePlaces& places) {
  PathEdge edge;
  const Configuration step = end - start;
  edge.length = step.cwiseQuotient(joints.acceleration).norm();
  edge.way = step / edge.length;
  const Configuration size = edge.way.cwiseAbs();
  edge.turn = rates.turn.dot(size);
  edge.travel = rates.travel.dot(size);
  edge.joint_rate = size.cwiseQuotient(joints.velocity).maxCoeff();
  edge.line_acceleration = 1 / size.cwiseQuotient(joints.acceleration).maxCoeff();
  places[1].put(rates, start + step / 2);
  places[2].put(rates, end);
  for (const ToolPlace& place : places) edge.ball = std::max(edge.ball, place.ball(edge.way).norm());
  const int halves =
      static_cast<int>(std::min<double>(max_parts, std::ceil(edge.turn * edge.length / (2 * finest_turn) + 1e-9)));
  ToolPlace between;
  for (int part = 1; halves > 1 && part < 2 * halves; ++part) {
    if (part == halves) continue;
    between.put(rates, start + step * part / (2 * halves));
    edge.ball = std::max(edge.ball, between.ball(edge.way).norm());
  }
  const double third = rates.orders(3) * edge.turn * edge.turn * edge.travel,
               part_length = edge.length / (2 * std::max(1, halves));
  edge.ball += third * part_length * part_length / 8;
  return edge;
}

EdgeBow bow_of(const ToolRates& rates, const PathEdge& edge, const EdgePlaces& places) {
  const ToolPlace &begin = places[0], &end = places[2];
  const Configuration step = edge.way * edge.length;
  const Vec3 line = end.pose.ball_m - begin.pose.ball_m,
             top_line = line + rates.stickout_m * (end.pose.axis - begin.pose.axis);
  const auto top = [&](const ToolPlace& place) { return place.top(step, rates.stickout_m); };
  // With the derivatives a and b of the deviation at its ends the cubic is a t (1 - t)^2 - b t^2 (1 - t).
  const double turned = edge.turn * edge.length;
  return {std::max((begin.ball(step) - line).norm(), (end.ball(step) - line).norm()) / 4,
          std::max((top(begin) - top_line).norm(), (top(end) - top_line).norm()) / 4,
          rates.orders(4) * turned * turned * turned * edge.travel * edge.length / 384};
}

}  // namespace sculpt
