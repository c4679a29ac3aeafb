#include "core/mill/mill_cuts.hpp"

namespace sculpt {
namespace {

/// A cutter in one direction.
struct Held {
  const Cutter& cutter;
  Vec3 axis;
  MillSweeps sweeps;
};

template <typename Visit>
void for_each_edge(const MillJob& job, const std::vector<MillCuts>& cuts, const Watch& watch, const Visit& visit) {
  for (const MillCuts& each : cuts) {
    const Cutter& cutter = job.tools[static_cast<std::size_t>(each.tool)].cutter;
    const ToolFrame frame(mill_directions()[static_cast<std::size_t>(each.direction)]);
    const Held held{cutter, frame.w, {cutter, frame.direction, job.wishes.stray_m(), job.grid.voxel_m}};
    for (const CutEdge& edge : each.edges) {
      if (watch.stop.stop_requested()) throw Cancelled{};
      visit(held, edge);
    }
  }
}

}  // namespace

void CutList::add(const Keyframe& keyframe) {
  const MillStep& step = *keyframe.mill;
  if (step.is_change()) tool_ = step.tool;
  if (keyframe.cut) {
    if (cuts_.empty() || cuts_.back().tool != tool_ || cuts_.back().direction != step.direction)
      cuts_.push_back({tool_, step.direction, {}});
    cuts_.back().edges.push_back({tip_, step.tip});
  }
  tip_ = step.tip;
}

void cut_nails(Nails& nails, const Cutter& cutter, const Vec3& axis, double stray_m, const CutEdge& edge) {
  if (cutter.kind != CutterKind::ball) return;
  const Vec3 to_middle = cutter.radius_m * axis;
  nails.cut(point_of(edge.from) + to_middle, point_of(edge.to) + to_middle, cutter.radius_m - stray_m);
}

void cut_again(const MillJob& job, const std::vector<MillCuts>& cuts, MillStock& stock, Nails& nails,
               const RunContext& run) {
  run.helpers.for_each_index(3, [&](std::size_t part) {
    SweptSet::Taken taken;
    for_each_edge(job, cuts, run.watch, [&](const Held& held, const CutEdge& edge) {
      if (part == 0) cut_nails(nails, held.cutter, held.axis, job.wishes.stray_m(), edge);
      if (part == 1) stock.clear(held.sweeps, edge.from, edge.to);
      if (part == 2) stock.remove(held.sweeps, edge.from, edge.to, taken);
      taken.clear();
    });
  });
}

}  // namespace sculpt
