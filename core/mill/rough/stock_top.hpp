// The stock from above as roughing planner sees it, and what a straight motion of a cutter takes off it.
#pragma once

#include <vector>

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
  /// Nothing stands above these heights: what was cut may have been hollow below.
  void lower_to(const HeightMap& tops);
  const Lattice& lattice() const { return map_.lattice; }

  /// Volume (m^3) that the cutter takes off on the way from one tip to the other (tool frame).
  double volume(const Vec3& from, const Vec3& to) const;
  /// Takes it off; calls `lowered(index, before)` for every cell that becomes lower.
  template <typename Lowered>
  void cut(const Vec3& from, const Vec3& to, const Lowered& lowered) {
    for_each_cut(from, to, [&](std::size_t at, float height) {
      const float before = map_.heights[at];
      map_.heights[at] = height;
      lowered(at, before);
    });
  }

 private:
  /// Calls `visit(index, height)` for the cells that become lower.
  template <typename Visit>
  void for_each_cut(const Vec3& from, const Vec3& to, const Visit& visit) const {
    const Lattice& cells = map_.lattice;
    const double du = to.x() - from.x(), dv = to.y() - from.y(), dw = to.z() - from.z();
    const double length2 = du * du + dv * dv, inverse = length2 > 0 ? 1 / length2 : 0;
    const double lowest = std::min(from.z(), to.z());
    const int first_a = std::max(0, cells.cell_u(std::min(from.x(), to.x()) - radius_)),
              last_a = std::min(cells.width - 1, cells.cell_u(std::max(from.x(), to.x()) + radius_));
    const int first_b = std::max(0, cells.cell_v(std::min(from.y(), to.y()) - radius_)),
              last_b = std::min(cells.height - 1, cells.cell_v(std::max(from.y(), to.y()) + radius_));
    for (int b = first_b; b <= last_b; ++b) {
      const double v = cells.v(b) - from.y();
      std::size_t at = cells.index(first_a, b);
      for (int a = first_a; a <= last_a; ++a, ++at) {
        const float top = map_.heights[at];
        if (!(static_cast<double>(top) > lowest)) continue;
        const double u = cells.u(a) - from.x();
        const double t = std::clamp((u * du + v * dv) * inverse, 0.0, 1.0);
        const double off_u = u - t * du, off_v = v - t * dv;
        const auto entry = static_cast<std::size_t>((off_u * off_u + off_v * off_v) * entries_per_m2_);
        if (entry >= profile_.size()) continue;
        const auto height = static_cast<float>(from.z() + t * dw + profile_[entry]);
        if (height < top) visit(at, height);
      }
    }
  }

  HeightMap map_;
  double radius_;          ///< of the cutter, less what it may be off
  double entries_per_m2_;  ///< of the profile, by the square of the distance of a cell's middle from the axis
  std::vector<double> profile_;
};

}  // namespace sculpt
