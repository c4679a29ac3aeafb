// What came of a job, in figures.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/mill/left/cure.hpp"
#include "core/mill/tool_figures.hpp"
#include "core/motion/residue.hpp"
#include "core/sweep/sweep.hpp"
#include "core/timing/time_figures.hpp"
#include "core/verify/robot/exempt_pair.hpp"

namespace sculpt {

/// What stands above the surface at random points of it.
struct ExcessFigures {
  std::uint64_t points = 0, within_tolerance = 0;
  double p50_m = 0, p95_m = 0, p99_m = 0, max_m = 0;
};

/// Of a job with milling tools.
struct SurfaceFigures {
  ExcessFigures all;              ///< as the replay measures it, but for the face that the part stands on
  ExcessFigures reachable;        ///< of what the given tools can come to, as the planner knows it
  std::uint64_t base_points = 0;  ///< of that face
  std::uint64_t gouged_points = 0;
  double gouge_m = 0;
};

/// The figures of `sculpt report` (proto/schema.json names them). Seconds are wall time.
struct Report {
  std::string mesh, robot, search;
  std::uint64_t seed = 0;
  int resolution = 0, threads = 1;
  struct {
    std::uint64_t total = 0, air = 0, keep = 0, remove = 0, removed = 0, residue = 0;
    std::uint64_t loose_keep = 0;         ///< of keep: what hangs on nothing once all around it is gone
    std::uint64_t loose_keep_pieces = 0;  ///< in how many pieces
    std::uint64_t freed =
        0;  ///< came loose from the table while it was carved, as the replay counts it (milled plans: chips not)
    std::uint64_t ambiguous = 0;  ///< the mesh does not say for sure whether they are inside
  } voxels;
  std::vector<std::pair<Reason, std::uint64_t>> residue;  ///< only reasons that occur
  struct {
    std::uint64_t leaves = 0, remove_leaves = 0;
  } octree;
  struct {
    std::uint64_t keyframes = 0, rows = 0, transits = 0;
    double cut_m = 0, travel_m = 0, joint_travel_rad = 0;
  } path;
  std::optional<SweepFigures> sweep;  ///< where the job was planned so
  std::vector<ToolFigures> tools;     ///< of a job that names some
  std::vector<Cure> cures;            ///< of what those left
  std::optional<SurfaceFigures> surface;
  std::optional<TimeFigures> time;  ///< of a clean plan that was to be timed
  /// For comparing planners. A move is one voxel edge of the ball's path, so moves per voxel are at least 1; checks are
  /// configurations tested.
  struct {
    double moves_per_voxel = 0, checks_per_voxel = 0;
    std::uint64_t turns = 0, ompl_calls = 0, ompl_solved = 0;
  } quality;
  struct {
    double load = 0, voxelize = 0, octree = 0, plan = 0, verify = 0, total = 0;
  } seconds;
  struct MayTouch {
    std::string first, second, why;  ///< names of links, and UncheckedLinks::why
  };
  std::vector<MayTouch> unchecked_links;  ///< links of which some shapes were not kept apart
  std::uint64_t peak_memory_bytes = 0;
  std::string plan_sha256;  ///< of the lines, whatever the form of the file
  struct {
    bool clean = false;
    std::uint64_t collisions = 0, voxels_checked = 0;
    std::vector<ExemptPair> exempt_pairs;  ///< links with shapes that the replay lets touch
  } verify;
  std::vector<std::string> findings;  ///< first sentences of an unclean replay
};

/// The report as one line of JSON (proto/schema.json), without "job" and "state", which the server adds.
std::string report_json(const Report& report);
/// One line {"voxel":[i,j,k],"reason":"..."} a voxel.
std::string residue_ndjson(const std::vector<Residue>& residue);

}  // namespace sculpt
