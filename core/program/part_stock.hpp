// What stands when a part begins. Internal to core/program.
#pragma once

#include <string>

#include "core/material/voxel_set.hpp"
#include "core/timing/plan_path.hpp"
#include "core/trajectory/milling/milled_stock.hpp"

namespace sculpt {

/// Follows a path from its start. A plan does not say what was clamped: this is the whole cube less what is cut, but
/// for what a thin tool cuts where nothing moves, which a path passes over.
class PartStock {
 public:
  /// `path` must outlive it.
  explicit PartStock(const PlanPath& path);

  /// Of the point, which is not before the one that was asked for last: as a .binvox.
  std::string at(std::size_t point);

 private:
  const PlanPath& path_;
  VoxelSet standing_;  ///< of a thin tool
  std::size_t done_ = 1;
  std::optional<MilledStock> milled_;
  std::size_t keyframe_ = 0;
};

}  // namespace sculpt
