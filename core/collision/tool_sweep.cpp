#include "core/collision/tool_sweep.hpp"

#include <algorithm>

namespace sculpt {
namespace {

/// Intervals whose tool moves less than this (voxel edges) and still is not certified count as touching.
constexpr double finest_motion = 0.004;
/// Edges longer than this (voxel edges) are probed before they are certified.
constexpr double long_motion = 3;

struct Sweep {
  const Material& material;
  const ToolEdge& edge;
  ToolRadii radii;  // margin included
  const Exempt& exempt;

  /// The path of a point over an interval of length w stays within second_derivative w^2 / 8 of its chord.
  bool is_free(double from, const ToolLine& start, double to, const ToolLine& end, bool ball_open,
               bool shank_open) const {
    const double width = to - from, middle = (from + to) / 2;
    const double chord_error = edge.second_derivative * width * width / 8;
    ball_open = ball_open && material.meets_capsule({start.ball, end.ball}, radii.ball + chord_error, exempt);
    if (!ball_open && !shank_open) return true;
    const ToolLine centre = edge.line_at(middle);
    if (ball_open && material.meets_capsule({centre.ball, centre.ball}, radii.ball, exempt)) return false;
    const double half_error = chord_error / 4;
    const double motion = half_error + std::max({(start.ball - centre.ball).norm(), (end.ball - centre.ball).norm(),
                                                 (start.top - centre.top).norm(), (end.top - centre.top).norm()});
    if (shank_open) {
      if (material.meets_capsule({centre.ball, centre.top}, radii.shank, exempt)) return false;
      shank_open = material.meets_capsule({centre.ball, centre.top}, radii.shank + motion, exempt);
    }
    if (!ball_open && !shank_open) return true;
    if (motion < finest_motion) return false;
    return is_free(from, start, middle, centre, ball_open, shank_open) &&
           is_free(middle, centre, to, end, ball_open, shank_open);
  }
};

/// Most edges that are not free touch over a good part of their length: a few poses find that out before the fine work
/// starts.
bool touches_at_a_glance(const Sweep& sweep) {
  for (int step = 8; step >= 1; step /= 2)
    for (int at = step; at < 16; at += 2 * step) {
      const ToolLine line = sweep.edge.line_at(at / 16.0);
      if (sweep.material.meets_capsule({line.ball, line.ball}, sweep.radii.ball, sweep.exempt)) return true;
      if (sweep.radii.shank > 0 && sweep.material.meets_capsule({line.ball, line.top}, sweep.radii.shank, sweep.exempt))
        return true;
    }
  return false;
}

}  // namespace

bool tool_sweep_is_free(const Material& material, const ToolEdge& edge, const ToolRadii& radii, double margin,
                        const Exempt& exempt) {
  const bool has_shank = radii.shank > 0;
  const Sweep sweep{material, edge, {radii.ball + margin, has_shank ? radii.shank + margin : 0}, exempt};
  const ToolLine &start = edge.start, &end = edge.end;
  if ((start.ball - end.ball).norm() + (start.top - end.top).norm() > long_motion && touches_at_a_glance(sweep))
    return false;
  return sweep.is_free(0, start, 1, end, true, has_shank);
}

}  // namespace sculpt
