// What stands when a part begins, of a plan with a thin tool. Internal to core/program.
#pragma once

#include <string>

#include "core/material/voxel_set.hpp"
#include "core/timing/plan_path.hpp"

namespace sculpt {

/// Follows a path from its start. A plan does not say what was clamped: this is the whole cube less what is cut, but
/// for what is cut where nothing moves, which a path passes over.
class PartStock {
 public:
  /// `path` must outlive it.
  explicit PartStock(const PlanPath& path) : path_(path), standing_(path.header().grid.n, true) {}

  /// Of the point, which is not before the one that was asked for last: as a .binvox.
  std::string at(std::size_t point);

 private:
  const PlanPath& path_;
  VoxelSet standing_;
  std::size_t done_ = 1;
};

}  // namespace sculpt
