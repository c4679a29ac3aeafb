#include "core/timing/edge.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/square.hpp"
#include "core/collision/shape/motion_bound.hpp"

namespace sculpt {
namespace {

constexpr double slower_by = 1e-3;     // of the ball's speed that what is not known of it may take
constexpr double finest_turn = 0.025;  // rad: shorter edges are not looked at in parts
constexpr int max_parts = 512;

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
/// 8 times the third derivative of the ball's place. There are as many parts as that needs to be next to nothing.
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
  places.end.put(rates, end);
  edge.ball = std::max(places.begin.ball(edge.way).norm(), places.end.ball(edge.way).norm());
  const double whole = rates.orders(3) * edge.turn * edge.turn * edge.travel * edge.length * edge.length / 8,
               turned = edge.turn * edge.length;
  const int parts = static_cast<int>(std::min(
      {double{max_parts}, std::ceil(turned / finest_turn), std::ceil(std::sqrt(whole / (slower_by * edge.ball)))}));
  ToolPlace between;
  for (int part = 1; part < parts; ++part) {
    between.put(rates, start + step * part / parts);
    edge.ball = std::max(edge.ball, between.ball(edge.way).norm());
  }
  edge.ball += whole / square(std::max(1, parts));
  return edge;
}

EdgeBow bow_of(const ToolRates& rates, const PathEdge& edge, const EdgePlaces& places) {
  const ToolPlace &begin = places.begin, &end = places.end;
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
