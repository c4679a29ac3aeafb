// The stock from above as roughing planner sees it, and what a straight motion of a cutter takes off it.
#pragma once

#include <optional>

#include "core/cell/milling/mill_tool.hpp"
#include "core/mill/map/height_map.hpp"

namespace sculpt {

/// Heights of the stock's top, lowered as it is cut; what is below a top counts as solid. Where a cell is cut in part
/// it counts as not cut, so that no height is too low. Not shared between threads.
class StockTop {
 public:
  /// `stands`: the heights at the start. `less_m`: the cutter may be off by so much, and cuts less.
  StockTop(HeightMap stands, const Cutter& cutter, double less_m);

  const HeightMap& map() const { return map_; }
  /// Nothing stands above these heights.
  void lower_to(const HeightMap& tops);
  const Lattice& lattice() const { return map_.lattice; }

  /// Volume (m^3) that the cutter takes off on the way from one tip to the other (tool frame).
  double volume(const Vec3& from, const Vec3& to) const;
  /// The highest place that it takes off there; nothing where that is none.
  std::optional<double> highest(const Vec3& from, const Vec3& to) const;
  /// Takes it off, and says how much it was (m^3).
  double cut(const Vec3& from, const Vec3& to);

 private:
  template <typename Visit>
  void for_each_row(const Vec3& from, const Vec3& to, const Visit& visit) const;

  HeightMap map_;
  double radius_;               ///< of the cutter, less what it may be off
  float flat_, rim_, raised_;   ///< of its end: as far as it is flat, the radius of the rim, what it may be off (m)
  float to_corner_, max_off2_;  ///< from a cell's middle; of cells that are covered, how far from the axis it is (m^2)
};

}  // namespace sculpt
