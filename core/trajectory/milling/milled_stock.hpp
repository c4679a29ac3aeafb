// The stock of a plan with milling tools, as its keyframes are read one by one.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "core/trajectory/header.hpp"
#include "core/trajectory/keyframe.hpp"
#include "core/trajectory/milling/swept_set.hpp"

namespace sculpt {

/// Not shared between threads.
class MilledStock {
 public:
  /// `header` is of a plan with milling tools. `stock`: at the start.
  MilledStock(const TrajectoryHeader& header, VoxelSet stock);

  /// Voxels in a row along x, both ends included.
  using Run = std::pair<Voxel, Voxel>;
  /// Carries out the next keyframe, a cut or none. Gives what it removes, each voxel once; valid until the next call.
  const std::vector<Run>& take(const MillStep& step, bool cut);

  const VoxelSet& standing() const { return stock_.voxels(); }

 private:
  const SweptCutter& cutter(int direction);
  void find_runs(const SweptSet::Taken& taken);

  MillHeader mill_;
  SweptSet stock_;
  int tool_ = 0;
  std::map<int, SweptCutter> cutters_;  ///< of this tool, by direction
  MillStep before_;
  std::vector<Run> runs_;
};

}  // namespace sculpt
