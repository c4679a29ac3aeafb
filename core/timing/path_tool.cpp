#include "core/timing/path_tool.hpp"

#include <algorithm>
#include <sstream>

#include "core/base/error.hpp"
#include "core/cell/link_tree.hpp"
#include "core/cell/milling/mounted_tool.hpp"
#include "core/collision/link_pairs.hpp"
#include "core/collision/margins.hpp"

namespace sculpt {
namespace {

constexpr double body_stray_m = 2e-4;  // of what is above the cutter: maps keep 0.3 mm off
constexpr double kept = 0.97;          // of what may be strayed: the rest is for the replay to prove

/// From the tip to the farthest point of all that is fixed to the tool link, at most (m).
double reach_of(const Cell& cell, const Chain& chain) {
  const std::vector<int> group = rigid_groups(cell.robot);
  std::vector<Frame> poses;
  chain.link_poses(cell.home(chain), poses);
  const auto tool = static_cast<std::size_t>(cell.tool_link);
  const Vec3 tip = poses[tool] * Vec3(0, 0, chain.stickout_m());
  double reach = 0;
  for (const Body& body : make_bodies(cell, make_tool(cell.tool, 1)))
    if (const auto link = static_cast<std::size_t>(body.link); group[link] == group[tool])
      reach = std::max(reach, (poses[link].translation() - tip).norm() + body.extent_m);
  return reach;
}

MillRoom room_of(const Cell& cell, const Chain& chain, const MillTool& tool, const MillHeader& header,
                 double reserve_m) {
  const double length = chain.stickout_m(), cutter_lever = (tool.cutter.flute_m + tool.cutter.radius_m) / length,
               body_lever = reach_of(cell, chain) / length;
  const double cutter_m = kept * header.stray_m / (1 + 2 * cutter_lever),
               body_m = kept * body_stray_m / (1 + 2 * body_lever), digits_m = 1e-6 / (1 + 2 * cutter_lever);
  const MillRoom room{std::min(cutter_m, body_m) - reserve_m, digits_m, body_m / 2 - reserve_m,
                      share_of_link_margin * link_margin_m - reserve_m};
  if (!(reserve_m >= 0) || !(room.cut_m > 0) || !(room.move_m > 0)) {
    std::ostringstream text;
    text << "a reserve of " << 1e6 * reserve_m << " um leaves nothing of the " << 1e6 * (room.cut_m + reserve_m)
         << " um that tool '" << tool.name
         << "' may stray in this plan: reserve less, or plan with a larger --tolerance";
    throw InputError("reserve_invalid", text.str());
  }
  return room;
}

StrayBound along(StrayBound stray, const PlanPath& path) {
  stray.look_along(path);
  return stray;
}

}  // namespace

PathTool::PathTool(const Cell& of, const PlanPath& path, double reserve_m)
    : cell(of),
      chain(cell.chain()),
      rates(chain),
      stray(along(StrayBound(cell, chain, path.header().grid, reserve_m), path)) {}

PathTool::PathTool(const Cell& of, const PlanPath& path, const MillTool& tool, double reserve_m)
    : cell(carrying(without_holder(of), tool)),
      chain(cell.chain()),
      rates(chain),
      stray(StrayBound::of_links(cell, chain, reserve_m)),
      feed_m_s(tool.feed_m_s),
      room(room_of(cell, chain, tool, *path.header().mill, reserve_m)) {}

PathTools::PathTools(const PlanPath& path, const Cell& cell, double reserve_m) {
  if (!path.header().mill) {
    tools_.push_back(std::make_unique<PathTool>(cell, path, reserve_m));
    return;
  }
  for (const MillTool& tool : path.header().mill->tools)
    tools_.push_back(std::make_unique<PathTool>(cell, path, tool, reserve_m));
}

}  // namespace sculpt
