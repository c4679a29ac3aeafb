// How much may a run of cuts take off? Depth times width of cut a unit of length, whatever part of the run is looked
// at.
#pragma once

#include "core/cell/milling/mill_tool.hpp"

namespace sculpt {

/// Of edges one after the other.
class ChipLoad {
 public:
  /// A stretch of the run, begun and ended anywhere within edges, takes off no more than `chip_m2` times its length and
  /// `max_m3`.
  ChipLoad(double chip_m2, double max_m3) : chip_m2_(chip_m2), max_m3_(max_m3) {}

  /// The run ends; what comes is not weighed with it.
  void begin() { load_m3_ = 0; }
  /// Takes the next edge, if no stretch is too heavy with it.
  bool bears(double volume_m3, double length_m);

 private:
  double chip_m2_, max_m3_;
  /// The heaviest stretch that ends with the last edge, above what its length allows; of the first edge the length does
  /// not count, as the stretch may begin at its end.
  double load_m3_ = 0;
};

/// Where volumes are known by whole voxels some more come off at once than depth times width: what a replay lets pass.
/// `voxel_m`: of the grid that the volumes are counted in.
ChipLoad counted_load(const MillTool& tool, double voxel_m);
/// So much, counted in voxels, may be taken off where the cutter is let down (m^3).
double max_plunged_m3(const MillTool& tool, double voxel_m);

}  // namespace sculpt
