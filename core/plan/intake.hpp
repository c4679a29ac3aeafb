// Job -> checked inputs: what can be refused before any planning, and mesh -> labelled voxels.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/base/watch.hpp"
#include "core/cell/cell.hpp"
#include "core/material/voxel_grid.hpp"
#include "core/mesh/mesh.hpp"
#include "core/plan/job.hpp"
#include "core/solid/voxelize.hpp"

namespace sculpt {

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
  std::uint64_t left_bytes = 0;  ///< of what the clampings before left
};
JobSizes sizes_of(const Job& job);

/// Bytes of memory that the job is expected to need at most: its files, what reading makes of them, and voxels. Throws
/// InputError `mesh_unreadable` for a kind of mesh that is not known.
std::uint64_t predict_memory(const JobSizes& sizes);

/// Throws InputError for what can be refused by that alone: `resolution_invalid`, `memory_cap`.
void check_sizes(const JobSizes& sizes, std::uint64_t memory_cap_bytes);

/// The target and the stock of a job. Their files are read when they are first needed, and only once.
class JobShapes {
 public:
  /// `job` must outlive the object.
  explicit JobShapes(const Job& job) : job_(job) {}

  /// The labelled voxels of `grid`, which differs from call to call in nothing but its resolution; those made last are
  /// kept. Those of a job of several clampings are of the last one. Throws InputError for files that are no shape, or
  /// none in this grid, and for clampings that do not fit; Cancelled.
  const VoxelGrid& voxelize(const Grid& grid, const Watch& watch);
  /// The target's surface as a mesh, placed (m, stock frame). Throws as `voxelize`, and InputError `mesh_unreadable`
  /// for one that is given as voxels.
  Mesh place_part(const Grid& grid, const Watch& watch);
  /// The same as `voxelize` for the last time: what was read is given up.
  VoxelGrid take_voxels(const Grid& grid, const Watch& watch) &&;

 private:
  const Mesh& read(const MeshFile& file, std::optional<Mesh>& mesh, const Watch& watch) const;
  VoxelSet make_stock(const Grid& grid, const Watch& watch);
  VoxelGrid place(const Grid& grid, const Watch& watch);
  Solid make_target(const Grid& grid, const Watch& watch);

  const Job& job_;
  std::optional<Mesh> target_, stock_;  ///< as the files have them
  std::optional<VoxelGrid> voxels_;
};

/// A job that may be planned, with what was read of it and made of it to find that out.
struct CheckedJob {
  Cell cell;
  Grid grid;
  JobShapes shapes;
  std::vector<MillTool> tools = {};  ///< of a job that names some
};

/// Checks all that can be checked before planning: resolution, search, cell, tool against voxel, mesh (loaded, finite,
/// a solid at a coarse grid), clampings, predicted memory, stock within reach of the chain, limits where
/// it is to be timed. Takes well under a second
/// for usual meshes. `job` must outlive what it returns. Throws InputError, Cancelled.
CheckedJob check_job(const Job& job, const Watch& watch);

/// Mesh (or .binvox) to labelled voxels, of a job that needs no check: `voxelize` and `verify FILE`. Throws InputError,
/// Cancelled.
VoxelGrid make_voxels(const Job& job, const Grid& grid, const Watch& watch);

/// What is loose or ambiguous of the target; told with every step of `run_job` from the first of `plan` on.
Doubts find_doubts(const VoxelGrid& voxels, const Grid& grid);

}  // namespace sculpt
