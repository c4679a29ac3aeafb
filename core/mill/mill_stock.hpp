// What stands while a plan with milling tools is carried out.
#pragma once

#include <cstdint>
#include <numbers>

#include "core/mill/map/tool_frame.hpp"
#include "core/trajectory/milling/swept_set.hpp"

namespace sculpt {

/// How far inside the cutter, which may be `stray_m` from where it should be, the centre of a voxel is whose cube it
/// sweeps.
inline double cube_margin_m(double stray_m, double voxel_m) {
  return stray_m + voxel_m * std::numbers::sqrt3 / 2;
}

/// The sweeps of one tool held in one direction.
struct MillSweeps {
  /// `stray_m`: how far the cutter may be from where it should be. `voxel_m`: of the grid.
  MillSweeps(const Cutter& cutter, const Direction& direction, double stray_m, double voxel_m);

  SweptCutter of_centres;  ///< a voxel counts as removed once its centre was swept
  SweptCutter of_cubes;    ///< and holds nothing any more once all of its cube was swept by one motion
};

/// Two sets of voxels: those that are not removed, and those in which something may stand. One thread may change the
/// one while another changes the other.
class MillStock {
 public:
  MillStock(const VoxelSet& stock, const Grid& grid) : left_(stock, grid), standing_(stock, grid) {}

  /// The cutter goes straight from one tip to the other. Gives the number of voxels that it removes, and adds them to
  /// `taken`.
  std::uint32_t remove(const MillSweeps& sweeps, const QuantaPoint& from, const QuantaPoint& to,
                       SweptSet::Taken& taken);
  void undo_remove(const SweptSet::Taken& taken) { left_.give_back(taken); }
  /// Nothing may stand any more in those whose cubes are swept.
  void clear(const MillSweeps& sweeps, const QuantaPoint& from, const QuantaPoint& to);

  /// Not removed yet.
  const SweptSet& left() const { return left_; }
  /// Where something may stand: all that is not in a cube of these is air.
  const VoxelSet& standing() const { return standing_.voxels(); }

 private:
  SweptSet left_, standing_;
};

}  // namespace sculpt
