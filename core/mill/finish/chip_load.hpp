// How much may a run of cuts take off? Depth times width of cut a unit of length, whatever part of the run is looked
// at.
#pragma once

#include "core/cell/milling/mill_tool.hpp"

namespace sculpt {

/// Of edges one after the other. Volumes are known by whole voxels: where these are coarse, some more come off at once
/// than depth times width.
class ChipLoad {
 public:
  /// `voxel_m`: of the grid that the volumes are counted in.
  ChipLoad(const MillTool& tool, double voxel_m);

  /// The run ends; what comes is not weighed with it.
  void begin() { load_m3_ = 0; }
  /// Takes the next edge, if no stretch of the run, begun and ended anywhere within edges, is too heavy with it.
  bool bears(double volume_m3, double length_m);
  /// May so much be taken off where the cutter is let down?
  bool bears_plunge(double volume_m3) const { return volume_m3 <= max_plunged_m3_; }

 private:
  double chip_m2_, max_m3_, max_plunged_m3_;
  /// The heaviest stretch that ends with the last edge, above what its length allows; of the first edge the length does
  /// not count, as the stretch may begin at its end.
  double load_m3_ = 0;
};

}  // namespace sculpt
