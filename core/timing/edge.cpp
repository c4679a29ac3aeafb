#include "core/timing/edge.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/square.hpp"
#include "core/collision/shape/motion_bound.hpp"

namespace sculpt {
namespace {

constexpr double slower_by = 2e-3;     // of the ball's speed that what is not known of it may take
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
  edge.begin = places.begin.motion(edge.way, rates.stickout_m);
  edge.end = places.end.motion(edge.way, rates.stickout_m);
  edge.ball = std::max(edge.begin.ball.norm(), edge.end.ball.norm());
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

EdgeSagitta sagitta_of(const ToolRates& rates, const PathEdge& edge, const EdgePlaces& places) {
  const ToolPose &begin = places.begin.pose, &end = places.end.pose;
  const Vec3 line = end.ball_m - begin.ball_m, top_line = line + rates.stickout_m * (end.axis - begin.axis);
  // With the derivatives a and b of the deviation at its ends the cubic is a t (1 - t)^2 - b t^2 (1 - t).
  const auto sagitta = [&](const Vec3& at_begin, const Vec3& at_end, const Vec3& straight) {
    return std::max((edge.length * at_begin - straight).norm(), (edge.length * at_end - straight).norm()) / 4;
  };
  const double turned = edge.turn * edge.length;
  return {sagitta(edge.begin.ball, edge.end.ball, line), sagitta(edge.begin.top, edge.end.top, top_line),
          rates.orders(4) * turned * turned * turned * edge.travel * edge.length / 384};
}

}  // namespace sculpt
