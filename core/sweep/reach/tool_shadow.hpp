// Where material stands in the way of a tilted tool.
#pragma once

#include <functional>

#include "core/material/voxel_set.hpp"

namespace sculpt {

/// What the standing voxels would darken if light came in along the tool's axis, on whole cells. With the ball at a
/// voxel's centre v and the axis along `lean`, each component 0, 1 or -1, the cells closer than half an edge to the
/// line from there on are v + m lean + w for m = 0, 1, 2..., the components of w each 0 or that of lean. If one of
/// them other than v stands, v is in the shadow: the tool does not fit. Not shared between threads.
class ToolShadow {
 public:
  /// `lean`: not along x alone, never down. The grid's n is a power of two, at least 4.
  ToolShadow(const VoxelSet& standing, Voxel lean);

  const VoxelSet& standing() const { return standing_; }

  /// Does the tool fit with its ball at `v`, but for v itself? Outside the grid: is v beyond it along the axis?
  bool is_clear(Voxel v) const { return !inside(v) || !dark_.contains(v); }

  /// `v` stands no longer. Calls `lit` for each voxel that comes out of the shadow.
  void remove(Voxel v, const std::function<void(Voxel)>& lit);
  /// `v` stands again.
  void put_back(Voxel v);

 private:
  bool inside(Voxel v) const {
    const auto in = [n = standing_.n()](int x) { return x >= 0 && x < n; };
    return in(v.i) && in(v.j) && in(v.k);
  }
  bool is_lit(Voxel v) const;
  void cast();

  VoxelSet standing_, dark_;
  Voxel lean_;
  std::vector<Voxel> beside_;  ///< all w but 0
};

}  // namespace sculpt
