// How much may a run of cuts take off? Depth times width of cut a unit of length, whatever part of the run is looked
// at.
#pragma once

#include <utility>
#include <vector>

#include "core/cell/milling/mill_tool.hpp"

namespace sculpt {

/// What a stretch of a run, begun and ended anywhere within edges, may take off.
struct ChipLimit {
  double chip_m2 = 0, burst_m3 = 0;  ///< no more than `chip_m2` times its length and `burst_m3`
  /// Where it is `window_m` long and ends with an edge, no more than `window_m2` times its length.
  double window_m = 0, window_m2 = 0;
};

/// Of edges one after the other.
class ChipLoad {
 public:
  explicit ChipLoad(const ChipLimit& limit) : limit_(limit) {}

  /// The run ends, and what comes is not weighed with it. `plunged_m3`: the next one takes off so much as it begins,
  /// which counts over the window only.
  void begin(double plunged_m3);
  /// Takes the next edge, if no stretch is too heavy with it.
  bool bears(double volume_m3, double length_m);
  /// Of a burst: how much of it the stretches that end here have used up.
  double used() const { return load_m3_ / limit_.burst_m3; }

 private:
  ChipLimit limit_;
  /// The heaviest stretch that ends with the last edge, above what its length allows; of the first edge the length does
  /// not count, as the stretch may begin at its end.
  double load_m3_ = 0;
  std::vector<std::pair<double, double>> last_;  ///< edges as long as the window: volumes, lengths
};

/// Over so much path (m) the volume that is counted in voxels says what is taken off: a diameter, or where a layer of
/// voxels more at either end is no more than a tenth.
double counted_window_m(const MillTool& tool, double voxel_m);
/// Where volumes are known by whole voxels some more come off at once than depth times width: what a replay lets pass;
/// but not over a `counted_window_m`. `voxel_m`: of the grid that the volumes are counted in.
ChipLoad counted_load(const MillTool& tool, double voxel_m);
/// So much, counted in voxels, may be taken off where the cutter is let down (m^3).
double max_plunged_m3(const MillTool& tool, double voxel_m);

}  // namespace sculpt
