// What a user asks for.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/frame.hpp"
#include "core/cell/cell.hpp"
#include "core/cell/milling/tool_library.hpp"
#include "core/search/search.hpp"
#include "core/solid/placement.hpp"
#include "core/timing/demand/motion_order.hpp"

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

/// Another clamping of what the one before left.
struct Clamping {
  MeshFile left;                     ///< a .binvox of what stood at the end of the one before, in its grid
  Vec3 rotation_rad = Vec3::Zero();  ///< of stock and target about the middle of the grid, as of a mesh by its
                                     ///< placement, by quarter turns; then they are set down on the floor
};

/// Milling tools, in the order that they are used in, and what the surface is to be like (m).
struct MillOrder {
  ToolLibraryFile library;
  std::vector<std::string> tools;
  double tolerance_m = 1e-4;  ///< what may stand above the surface where the tools come to it
  std::optional<double> scallop_m = {}, allowance_m = {};  ///< of it; by default these shares

  static constexpr double scallop_share = 0.35, allowance_share = 0.1;
  double scallop() const { return scallop_m.value_or(scallop_share * tolerance_m); }
  double allowance() const { return allowance_m.value_or(allowance_share * tolerance_m); }
};

struct Job {
  MeshFile mesh;
  CellFiles cell;
  int resolution = 0;  ///< power of two, 8 to 1024
  Search search = Search::sweep;
  std::optional<MillOrder> mill = {};      ///< there if, and only if, `search` is mill
  std::optional<MotionOrder> motion = {};  ///< how fast the plan is to be gone through; it does not change the plan
  std::uint64_t seed = 0;
  int threads = 1;           ///< the plan is the same at any number
  bool allow_freed = false;  ///< a translating robot need not keep pieces from coming loose; arms always do
  Placement placement;
  Stock stock;
  std::vector<Clamping>
      clampings;  ///< behind the first, which `placement` and `stock` are about; the last is this job's
  std::uint64_t memory_cap_bytes = 2ull << 30;
  std::filesystem::path keep_fields = {};  ///< folder for fields of `sweep` (FieldStore); empty: they are not kept
};

}  // namespace sculpt
