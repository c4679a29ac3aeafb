#include "core/doctor/make/new_cell.hpp"

#include <algorithm>
#include <functional>

#include "core/doctor/describe_cell.hpp"
#include "core/doctor/find_home.hpp"
#include "core/doctor/make/cell_maker.hpp"
#include "core/doctor/probe_reach.hpp"

namespace sculpt {
namespace {

constexpr std::size_t looked_at_in_full = 6;
constexpr int fine_resolution = 64;

Scene full_scene(const Cell& cell, int resolution) {
  const Grid grid = cell.grid(resolution);
  return Scene(cell, grid, VoxelSet(grid.n, true));
}

/// How much of the stock is reached there, over all directions and over each; below 0 without a home.
double worth_of(const Cell& cell, const RunContext& run) {
  const Scene scene = full_scene(cell, coarse_resolution);
  const auto home = find_home(scene, cell.home(scene.chain()), run);
  if (!home) return -1;
  const Reach reach = find_reach(scene, home->q, coarse_places, run);
  double worth = reach.reached + home->reach + 0.1 * home->limit_margin;
  for (const DirectionFinding& direction : reach.directions)
    worth += static_cast<double>(direction.free) / direction.places / static_cast<double>(reach.directions.size());
  return worth;
}

/// With a tool that is thin enough for few voxels.
Cell coarse_cell(const CellMaker& maker, const Vec3& table_m) {
  Cell cell = maker.make(table_m).cell;
  cell.tool = {ball_voxels, shank_voxels, true, cell.tool.stickout_m};
  return cell;
}

/// Those of the places, in their order, where the joints alone reach most.
std::vector<Vec3> promising_places(const CellMaker& maker, const std::vector<Vec3>& places, const RunContext& run) {
  std::vector<int> reached(places.size());
  run.helpers.for_each_index(places.size(), [&](std::size_t at) {
    run.watch.step(Stage::plan, 0, 0);
    const Cell cell = coarse_cell(maker, places[at]);
    reached[at] = count_joint_reach(cell, cell.home(cell.chain()));
  });
  std::vector<int> sorted = reached;
  std::nth_element(sorted.begin(), sorted.begin() + looked_at_in_full - 1, sorted.end(), std::greater<>());
  const int least = sorted[looked_at_in_full - 1];
  std::vector<Vec3> left;
  for (std::size_t at = 0; at < places.size(); ++at)
    if (reached[at] > least) left.push_back(places[at]);
  for (std::size_t at = 0; at < places.size() && left.size() < looked_at_in_full; ++at)
    if (reached[at] == least) left.push_back(places[at]);
  return left;
}

Vec3 best_place(const CellMaker& maker, const RunContext& run) {
  std::vector<Vec3> places = maker.places();
  if (places.size() == 1) return places.front();
  places = promising_places(maker, places, run);
  std::vector<double> worth(places.size());
  run.helpers.for_each_index(places.size(),
                             [&](std::size_t at) { worth[at] = worth_of(coarse_cell(maker, places[at]), run); });
  return places[static_cast<std::size_t>(std::max_element(worth.begin(), worth.end()) - worth.begin())];
}

/// Gives the cell a home that is free with the pairs of links that this home itself makes out. False if there is none.
bool settle(Cell& cell, const RunContext& run) {
  int resolution = fine_resolution;
  while (resolution > 8 && !cell.tool.in_voxels && cell.tool.ball_radius >= 0.49 * cell.stock_size_m / resolution)
    resolution /= 2;
  for (int again = 0; again < 2; ++again) {
    const Scene scene = full_scene(cell, resolution);
    const auto home = find_home(scene, cell.home(scene.chain()), run);
    if (!home) return false;
    for (int c = 0; c < scene.chain().dof(); ++c)
      cell.rest[static_cast<std::size_t>(scene.chain().joints()[static_cast<std::size_t>(c)])] = home->q[c];
    follow_leaders(cell.robot, cell.rest);
    const Scene checked = full_scene(cell, resolution);
    if (checked.contact_at(cell.home(checked.chain())) == Contact::none) return true;
  }
  return false;
}

}  // namespace

NewCell make_cell(const MakersRobot& robot, const CellWishes& wishes, const RunContext& run) {
  CellMaker maker(robot, wishes);
  maker.ignore_contacts(maker.make(maker.places().front()).cell);
  const Vec3 table_m = best_place(maker, run);
  auto [urdf, cell] = maker.make(table_m);
  NewCell made{std::move(urdf), std::move(cell), {}, false};
  made.has_home = settle(made.cell, run);
  if (maker.ignore_contacts(made.cell)) {
    made.cell = maker.make(table_m).cell;
    made.has_home = settle(made.cell, run);
  }
  made.remarks = maker.remarks(table_m);
  return made;
}

}  // namespace sculpt
