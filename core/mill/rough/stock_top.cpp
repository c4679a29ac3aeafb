#include "core/mill/rough/stock_top.hpp"

#include <cmath>
#include <numbers>

namespace sculpt {
namespace {

constexpr std::size_t entries = 2048;

}  // namespace

StockTop::StockTop(HeightMap stands, const Cutter& cutter, double less_m)
    : map_(std::move(stands)), radius_(cutter.radius_m - less_m) {
  // What is true of the farthest corner of a cell is true of all of it.
  const double to_corner = map_.lattice.step / std::numbers::sqrt2;
  const double reach = std::max(0.0, radius_ - to_corner);
  entries_per_m2_ = static_cast<double>(entries) / std::max(reach * reach, 1e-12);
  for (std::size_t entry = 0; entry < entries; ++entry) {
    const double r = std::sqrt(static_cast<double>(entry + 1) / entries_per_m2_) + to_corner;
    // A smaller cutter, its tip higher: of a ball the sphere about the same centre.
    const double height = cutter.height_m(std::min(r + less_m, cutter.radius_m)) + less_m;
    profile_.push_back(height);
  }
  if (reach <= 0) profile_.clear();
}

void StockTop::lower_to(const HeightMap& tops) {
  for (std::size_t at = 0; at < map_.heights.size(); ++at)
    map_.heights[at] = std::min(map_.heights[at], tops.heights[at]);
}

double StockTop::volume(const Vec3& from, const Vec3& to) const {
  double heights = 0;
  for_each_cut(from, to,
               [&](std::size_t at, float height) { heights += static_cast<double>(map_.heights[at] - height); });
  return heights * map_.lattice.step * map_.lattice.step;
}

}  // namespace sculpt
