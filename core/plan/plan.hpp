// A job from mesh bytes to verified trajectory: the one place that sees all stages.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/watch.hpp"
#include "core/cell/cell.hpp"
#include "core/material/placement.hpp"
#include "core/material/voxel_grid.hpp"
#include "core/motion/residue.hpp"
#include "core/verify/exempt_pair.hpp"

namespace sculpt {

/// A file's content and its kind ("stl", "binvox"...; lower case, no dot).
struct MeshFile {
  std::string bytes;
  std::string extension;
  std::string name;  ///< for the report
};

/// What is clamped at the start: the whole grid, or a box of it, or a mesh in the same frame as the placed target.
struct Stock {
  struct Box {
    Vec3 min_m, max_m;
  };  ///< metres from the corner of voxel (0,0,0)
  std::optional<Box> box;
  std::optional<MeshFile> mesh;  ///< metres from the corner of voxel (0,0,0); or a .binvox of the same resolution
};

struct Job {
  MeshFile mesh;
  CellFiles cell;
  int resolution = 0;            ///< power of two, 8 to 1024
  std::string search = "sweep";  ///< sweep, octree or voxel; translating robots carve by octree instead of by sweep
  std::uint64_t seed = 0;
  int threads = 1;           ///< the plan is the same at any number
  bool allow_freed = false;  ///< a translating robot need not keep pieces from coming loose; arms always do
  Placement placement;
  Stock stock;
  std::uint64_t memory_cap_bytes = 2ull << 30;
};

/// The figures of `sculpt report` (DESIGN section 5). Seconds are wall time.
struct Report {
  std::string mesh, robot, search;
  std::uint64_t seed = 0;
  int resolution = 0, threads = 1;
  struct {
    std::uint64_t total = 0, air = 0, keep = 0, remove = 0, removed = 0, residue = 0;
    std::uint64_t loose_keep = 0;         ///< of keep: what hangs on nothing once all around it is gone
    std::uint64_t loose_keep_pieces = 0;  ///< in how many pieces
    std::uint64_t freed = 0;              ///< came loose from the table while it was carved, as the replay counts it
    std::uint64_t ambiguous = 0;          ///< the mesh does not say for sure whether they are inside
  } voxels;
  std::vector<std::pair<Reason, std::uint64_t>> residue;  ///< only reasons that occur
  struct {
    std::uint64_t leaves = 0, remove_leaves = 0;
  } octree;
  struct {
    std::uint64_t keyframes = 0, rows = 0, transits = 0;
    double cut_m = 0, travel_m = 0, joint_travel_rad = 0;
  } path;
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

struct JobResult {
  Report report;
  VoxelGrid voxels;
  Grid grid;
  std::vector<Residue> residue;
};

/// What can be known of a job before its files are read.
struct JobSizes {
  struct File {
    std::uint64_t bytes = 0;
    std::string extension;
  };
  int resolution = 0;
  File mesh;
  std::optional<File> stock;
  std::uint64_t cell_bytes = 0;  ///< of all files of the cell
};
JobSizes sizes_of(const Job& job);

/// Bytes of memory that the job is expected to need at most: its files, what reading makes of them, and voxels. Throws
/// InputError `mesh_unreadable` for a kind of mesh that is not known.
std::uint64_t predict_memory(const JobSizes& sizes);

/// Throws InputError for what can be refused by that alone: `resolution_invalid`, `memory_cap`.
void check_sizes(const JobSizes& sizes, std::uint64_t memory_cap_bytes);

/// Checks all that can be checked before planning: resolution, search, cell, tool against voxel, mesh (loaded, finite,
/// a solid at a coarse grid), predicted memory, stock within reach of the chain. Takes well under a second for usual
/// meshes. Throws InputError.
void check_job(const Job& job, const Watch& watch);

/// Mesh (or .binvox) to labelled voxels; used by planning, `voxelize` and `verify FILE`. Throws InputError, Cancelled.
VoxelGrid make_voxels(const Job& job, const Grid& grid, const Watch& watch);

/// What is loose or ambiguous of the target; told with every step of `run_job` from the first of `plan` on.
Doubts find_doubts(const VoxelGrid& voxels, const Grid& grid);

enum class TrajectoryForm { text, binary };  // .ndjson, .sct

/// Plans, writing to `trajectory` what is final beside the planning, on a thread of its own (lines are flushed at least
/// once per block or layer), then verifies the written file. Before anything is planned `watch` is told how much of the
/// target hangs on nothing. Throws InputError (refused) or Cancelled; a plan with residue is a result, not an error.
/// Any thread; several jobs may run at once.
JobResult run_job(const Job& job, const std::filesystem::path& trajectory, const Watch& watch,
                  TrajectoryForm form = TrajectoryForm::text);

/// Where a run keeps checkpoints, and how old the last one is when the next is due, after the unit then in work. At a
/// stop it keeps what units had finished, whatever the time.
struct CheckpointPlace {
  std::filesystem::path folder;
  std::chrono::duration<double> interval = std::chrono::seconds(5);
};

/// run_job in the text form that goes on where a run of the same job with the same place and trajectory file was
/// stopped or killed, at its last checkpoint, and gives what that one would have given: the same bytes, the same report
/// but for seconds, memory and threads. Where no checkpoint is whole and of this job and program, it starts over.
/// Checkpoints are left in the folder (remove_checkpoints). Throws as run_job.
JobResult resume_job(const Job& job, const std::filesystem::path& trajectory, const CheckpointPlace& place,
                     const Watch& watch);

/// The report as the JSON object of DESIGN section 5, without "job" and "state", which the server adds; one line.
std::string report_json(const Report& report);
/// One line {"voxel":[i,j,k],"reason":"..."} a voxel.
std::string residue_ndjson(const std::vector<Residue>& residue);

}  // namespace sculpt
