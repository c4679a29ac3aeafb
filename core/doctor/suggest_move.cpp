#include "core/doctor/suggest_move.hpp"

#include <algorithm>
#include <cstdio>

#include "core/doctor/probe_reach.hpp"

namespace sculpt {
namespace {

constexpr std::array steps{0.5, 1.0};  // in edges of the stock
constexpr std::size_t tried_in_full = 3;
constexpr double worth_it = 0.05;  // of reach

/// Joints from the link up to the root.
std::vector<int> joints_above(const Robot& robot, int link) {
  std::vector<int> joints;
  for (int joint = robot.links[static_cast<std::size_t>(link)].parent_joint; joint >= 0;
       joint = robot.links[static_cast<std::size_t>(robot.joints[static_cast<std::size_t>(joint)].parent_link)]
                   .parent_joint)
    joints.push_back(joint);
  return joints;
}

/// The joint nearest to the root that carries the stock and not the tool; -1 if none does.
int table_joint(const Cell& cell) {
  const std::vector<int> of_tool = joints_above(cell.robot, cell.tool_link);
  int table = -1;
  for (const int joint : joints_above(cell.robot, cell.stock_link))
    if (std::find(of_tool.begin(), of_tool.end(), joint) == of_tool.end()) table = joint;
  return table;
}

/// Mean share over the straight directions.
double mean_free(const std::vector<DirectionFinding>& directions) {
  double sum = 0;
  for (const DirectionFinding& direction : directions) sum += static_cast<double>(direction.free) / direction.places;
  return directions.empty() ? 0 : sum / static_cast<double>(directions.size());
}

double worth(const Reach& reach) {
  return reach.reached + mean_free(reach.directions);
}

Reach reach_of(const Cell& cell, const Configuration& start, const RunContext& run) {
  const Grid grid = cell.grid(coarse_resolution);
  ToolSpec thin = cell.tool;
  Cell coarse = cell;
  coarse.tool.ball_radius = std::min(thin.ball_radius, thin.in_voxels ? 0.45 : 0.45 * grid.voxel_m);
  coarse.tool.shank_radius = std::min(thin.shank_radius, coarse.tool.ball_radius);
  return find_reach(Scene(coarse, grid, VoxelSet(grid.n, true)), start, coarse_places, run);
}

struct Move {
  Vec3 by_m;
  int kinematic;
};

std::vector<Move> moves_of(const Cell& cell, const Configuration& start, const Watch& watch) {
  std::vector<Move> moves;
  for (const double step : steps)
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {1.0, -1.0}) {
        watch.step(Stage::plan, 0, 0);
        const Vec3 by = side * step * cell.stock_size_m * Vec3::Unit(axis);
        moves.push_back({by, count_joint_reach(move_table(cell, by), start)});
      }
  std::stable_sort(moves.begin(), moves.end(), [](const Move& a, const Move& b) { return a.kinematic > b.kinematic; });
  return moves;
}

std::string text_of(const Vec3& by_m) {
  int axis = 0;
  by_m.cwiseAbs().maxCoeff(&axis);
  char text[64];
  std::snprintf(text, sizeof text, "by %+.2f m along %c", by_m[axis], "xyz"[axis]);
  return text;
}

}  // namespace

Cell move_table(const Cell& cell, const Vec3& by_m) {
  Cell moved = cell;
  const int joint = table_joint(cell);
  if (joint < 0)
    moved.stock_origin_m += by_m;
  else
    moved.robot.joints[static_cast<std::size_t>(joint)].origin.pretranslate(by_m);
  return moved;
}

std::optional<Fault> suggest_move(const Cell& cell, const Configuration& start, const CellFindings& found,
                                  const RunContext& run) {
  if (cell.chain().translating() || found.directions.empty()) return std::nullopt;
  const Reach now = reach_of(cell, start, run);
  std::vector<Move> moves = moves_of(cell, start, run.watch);
  moves.resize(std::min(moves.size(), tried_in_full));
  const Move* best = nullptr;
  Reach best_reach = now;
  for (const Move& move : moves) {
    Reach reach = reach_of(move_table(cell, move.by_m), start, run);
    if (worth(reach) <= worth(best_reach) + worth_it) continue;
    best = &move;
    best_reach = std::move(reach);
  }
  if (best == nullptr) return std::nullopt;
  const int joint = table_joint(cell);
  const std::string what =
      joint < 0 ? "\"stock\": {\"origin_m\"} in the cell file"
                : "the <origin> of joint '" + cell.robot.joints[static_cast<std::size_t>(joint)].name + "' in the URDF";
  char gain[128];
  std::snprintf(gain, sizeof gain,
                "%.0f %% of the places instead of %.0f %%, a straight direction on average %.0f %% instead of %.0f %%",
                100 * best_reach.reached, 100 * now.reached, 100 * mean_free(best_reach.directions),
                100 * mean_free(now.directions));
  return Fault{Fault::Weight::note, "better_place",
               "with the stock elsewhere the arm would reach more: " + std::string(gain) + " (estimated)",
               "shift " + what + " " + text_of(best->by_m) + ", with all that stands below it"};
}

}  // namespace sculpt
