#include "core/mill/mill_stock.hpp"

namespace sculpt {

MillSweeps::MillSweeps(const Cutter& cutter, const Direction& direction, double stray_m, double voxel_m)
    : of_centres(cutter, direction, stray_m), of_cubes(cutter, direction, cube_margin_m(stray_m, voxel_m)) {}

std::uint32_t MillStock::remove(const MillSweeps& sweeps, const QuantaPoint& from, const QuantaPoint& to,
                                SweptSet::Taken& taken) {
  return left_.take(sweeps.of_centres, from, to, &taken);
}

void MillStock::clear(const MillSweeps& sweeps, const QuantaPoint& from, const QuantaPoint& to) {
  standing_.take(sweeps.of_cubes, from, to);
}

}  // namespace sculpt
