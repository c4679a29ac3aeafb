#include "core/mill/mill.hpp"

#include <algorithm>
#include <utility>

#include "core/mill/carver.hpp"
#include "core/mill/finish/finish_stage.hpp"
#include "core/mill/left/cures.hpp"
#include "core/mill/rough/rough_stage.hpp"

namespace sculpt {

const std::vector<Direction>& mill_directions() {
  static const std::vector<Direction> directions = [] {
    std::vector<Direction> all{{0, 0, 1}};
    const auto turned = [](const Direction& d) { return Direction{-d[1], d[0], d[2]}; };
    // Level, level between two sides, leaning over one side and over an edge, and from below the horizon by 30 degrees.
    for (Direction d : {Direction{1, 0, 0}, {1, 1, 0}, {1, 0, 1}, {1, 1, 1}, {26, 0, -15}, {18, 18, -15}})
      for (int quarter = 0; quarter < 4; ++quarter, d = turned(d)) all.push_back(d);
    return all;
  }();
  return directions;
}

namespace {

void use_tool(const MillJob& job, std::size_t number, PartViews& views, Carver& carver, const RunContext& run) {
  const auto is_ball = [](const MillTool& tool) { return tool.cutter.kind == CutterKind::ball; };
  rough(job, carver, run);
  if (!is_ball(job.tools[number])) return;
  const auto next = std::find_if(job.tools.begin() + static_cast<std::ptrdiff_t>(number) + 1, job.tools.end(), is_ball);
  finish(job, views, carver, next != job.tools.end() ? &*next : nullptr, run);
}

}  // namespace

MillResult mill(const MillJob& job, std::optional<MillStart> start, const MillListener& listener,
                const RunContext& run) {
  MillResult result;
  Carver carver(job, listener.emit, run);
  PartViews views(job.part, mill_directions().size());
  std::size_t number = 0;
  if (start)
    number = carver.go_on(*std::move(start));
  else
    carver.take_tool(0);
  use_tool(job, number, views, carver, run);
  while (++number < job.tools.size()) {
    carver.take_tool(number);
    listener.changed(carver.memory());
    use_tool(job, number, views, carver, run);
  }
  carver.go_home();
  result.tools = carver.figures();
  result.left = carver.left().voxels();
  VoxelSet wanted = result.left;
  wanted -= job.voxels.keep;
  result.cures = find_cures(job, wanted, views, run);
  const Nails& nails = carver.nails();
  for (std::size_t at = 0; at < nails.size(); ++at)
    if (nails.is_reachable(at) || nails.excess(at) <= job.wishes.tolerance_m)
      result.reachable.push_back(std::min(nails.excess(at), Nails::farthest_m));
  return result;
}

}  // namespace sculpt
