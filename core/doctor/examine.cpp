#include "core/doctor/examine.hpp"

#include <algorithm>

#include "core/base/stopwatch.hpp"
#include "core/collision/link_pairs.hpp"
#include "core/collision/wide_contacts.hpp"
#include "core/doctor/body_names.hpp"
#include "core/doctor/describe_cell.hpp"
#include "core/doctor/find_faults.hpp"
#include "core/doctor/find_home.hpp"
#include "core/doctor/home_values.hpp"
#include "core/doctor/probe_reach.hpp"
#include "core/doctor/suggest_move.hpp"
#include "core/sweep/directions.hpp"
#include "core/verify/home_contacts.hpp"

namespace sculpt {
namespace {

constexpr int sampled_per_edge = 32;
constexpr double look_around_m = 0.02;  // what is nearer to something at home is told

double holder_length_m(const ToolSpec& tool) {
  double length = 0;
  for (const HolderSection& section : tool.holder) length += section.length_m;
  return length;
}

HomeFinding describe_home(const Scene& scene, const Configuration& home) {
  HomeFinding found;
  found.q.assign(home.begin(), home.end());
  const ToolPose pose = scene.chain().tool_pose(home);
  found.ball_m = pose.ball_m - scene.grid().origin_m;
  found.axis = pose.axis;
  for (const NearBodies& near : scene.near_bodies(home, look_around_m)) {
    PairFinding pair = name_bodies(scene.chain().robot(), near.first, near.second);
    pair.gap_m = near.gap_m;
    if (near.too_near) {
      found.blocking.push_back(std::move(pair));
      found.bodies.push_back(near);
    } else if (!found.nearest || pair.gap_m < found.nearest->gap_m) {
      found.nearest = std::move(pair);
    }
  }
  return found;
}

void describe_pairs(const Cell& cell, CellFindings& found) {
  const LinkPairs pairs = find_link_pairs(cell);
  for (const CheckedLinks& checked : pairs.checked)
    found.checked_pairs.push_back(name_bodies(cell.robot, checked.links.first, checked.links.second));
  for (const UncheckedLinks& unchecked : pairs.unchecked) {
    found.unchecked_pairs.push_back(name_bodies(cell.robot, unchecked.links.first, unchecked.links.second));
    found.unchecked_pairs.back().why = unchecked.why;
  }
  for (const LinkPair& contact : find_home_contacts(cell, cell.chain().joints()))
    found.home_contacts.push_back(name_bodies(cell.robot, contact.first, contact.second));
  for (const WideContact& wide : find_wide_contacts(cell, pairs.checked)) {
    found.wide_pairs.push_back(name_bodies(cell.robot, wide.links.first, wide.links.second));
    found.wide_pairs.back().why = describe(wide, cell.robot);
  }
}

/// What needs no scene.
CellFindings describe(const Cell& cell, const Chain& chain) {
  CellFindings found;
  found.name = cell.name;
  found.stock_link = cell.robot.links[static_cast<std::size_t>(cell.stock_link)].name;
  found.tool_link = cell.robot.links[static_cast<std::size_t>(cell.tool_link)].name;
  found.chain = describe_chain(cell, chain);
  found.idle_joints = find_idle_joints(cell, chain);
  found.bodies = describe_bodies(cell);
  found.stock_size_m = cell.stock_size_m;
  found.stickout_m = cell.tool.stickout_m;
  found.free_length_m = cell.tool.stickout_m - holder_length_m(cell.tool);
  describe_pairs(cell, found);
  return found;
}

/// Of the resolution that was asked for and coarser ones the first that the tool is thin enough for.
int usable_resolution(const Cell& cell, int resolution, std::vector<Fault>& faults) {
  for (int n = resolution; n >= 8; n /= 2) try {
      make_tool(cell.tool, cell.grid(n).voxel_m, n);
      return n;
    } catch (const InputError& error) {
      if (n == resolution)
        faults.push_back(
            {Fault::Weight::error, error.code(), error.what(), "use a thinner tool or a lower resolution"});
    }
  return 0;
}

/// Share of the stock in which some field along the axis may be used.
double certified_share(const Directions& directions, const Vec3& axis, int n) {
  std::vector<std::size_t> along;
  for (std::size_t d = 0; d < directions.size(); ++d)
    if (directions.is_straight(d) && directions.view(d).axis().isApprox(axis)) along.push_back(d);
  const int step = std::max(1, n / sampled_per_edge);
  int usable = 0, all = 0;
  for (int k = 0; k < n; k += step)
    for (int j = 0; j < n; j += step)
      for (int i = 0; i < n; i += step, ++all)
        usable += std::any_of(along.begin(), along.end(), [&](std::size_t d) {
          const Voxel cell = directions.view(d).cell({i, j, k});
          return directions.may_reach(d, Vec3(cell.i, cell.j, cell.k));
        });
  return static_cast<double>(usable) / all;
}

void find_fields(const Scene& scene, const Configuration& home, const FieldStore& store, const RunContext& run,
                 CellFindings& found) {
  found.fields_kept = store.has(0);
  const Stopwatch watch;
  Directions directions(scene, home, run, store);
  directions.find_straight_fields();
  found.fields_s = watch.seconds();
  for (DirectionFinding& direction : found.directions)
    direction.field = certified_share(directions, direction.axis, scene.grid().n);
}

}  // namespace

CellFindings examine_cell(const CellDraft& draft, const ExamineSettings& settings, const RunContext& run) {
  const Cell& cell = draft.cell;
  const Chain chain = cell.chain();
  CellFindings found = describe(cell, chain);
  find_faults_of_files(draft, found);
  found.resolution = usable_resolution(cell, settings.resolution, found.faults);
  if (found.resolution == 0) return found;
  const Grid grid = cell.grid(found.resolution);
  found.ball_radius_m = make_tool(cell.tool, grid.voxel_m, grid.n).ball_radius_m;

  const Stopwatch watch;
  const Scene scene(cell, grid, VoxelSet(grid.n, true));
  found.scene_s = watch.seconds();
  const Configuration home = cell.home(chain);
  found.home = describe_home(scene, home);
  Configuration start = home;
  if (home_is_poor(draft, found))
    if (const auto better = find_home(scene, home, run)) {
      found.better_home = name_values(chain, better->q);
      start = better->q;
    }
  find_faults_of_home(draft, found);
  Reach reach = find_reach(scene, start, settings.places_per_edge, run);
  found.directions = std::move(reach.directions);
  found.reached = reach.reached;
  if (settings.fields && !chain.translating())
    find_fields(scene, start, start == home ? settings.store : FieldStore{}, run, found);
  find_faults_of_reach(chain, found);
  if (reach_is_poor(found))
    if (const auto move = suggest_move(cell, start, found, run)) found.faults.push_back(*move);
  std::stable_sort(found.faults.begin(), found.faults.end(),
                   [](const Fault& a, const Fault& b) { return a.weight > b.weight; });
  return found;
}

CellFindings examine_files(const CellFiles& files, const ExamineSettings& settings, const RunContext& run) {
  try {
    return examine_cell(draft_cell(files), settings, run);
  } catch (const InputError& error) {
    return unreadable_cell(files.name, error);
  }
}

CellFindings unreadable_cell(const std::string& name, const InputError& error) {
  CellFindings found;
  found.name = name;
  found.faults.push_back({Fault::Weight::error, error.code(), error.what(), "mend that place and look again"});
  return found;
}

}  // namespace sculpt
