#include "core/mill/rough/stock_top.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace sculpt {
namespace {

/// Raises a cell that is not covered above everything, however little it is out of reach (m^2).
constexpr float far_above = 1e12F;

}  // namespace

StockTop::StockTop(HeightMap stands, const Cutter& cutter, double less_m)
    : map_(std::move(stands)),
      radius_(cutter.radius_m - less_m),
      flat_(static_cast<float>(cutter.radius_m - cutter.corner_radius_m)),
      rim_(static_cast<float>(cutter.corner_radius_m)),
      raised_(static_cast<float>(less_m)),
      to_corner_(static_cast<float>(map_.lattice.step / std::numbers::sqrt2)) {
  const float reach = static_cast<float>(radius_) - to_corner_;
  max_off2_ = reach > 0 ? reach * reach : -1;
}

void StockTop::lower_to(const HeightMap& tops) {
  for (std::size_t at = 0; at < map_.heights.size(); ++at)
    map_.heights[at] = std::min(map_.heights[at], tops.heights[at]);
}

/// Calls `visit(index, heights)` for rows of cells around the way of which any is higher than its lowest place: the
/// first cell, and what the cutter leaves of each.
template <typename Visit>
void StockTop::for_each_row(const Vec3& from, const Vec3& to, const Visit& visit) const {
  const Lattice& cells = map_.lattice;
  const int first_a = std::max(0, cells.cell_u(std::min(from.x(), to.x()) - radius_)),
            last_a = std::min(cells.width - 1, cells.cell_u(std::max(from.x(), to.x()) + radius_));
  const int first_b = std::max(0, cells.cell_v(std::min(from.y(), to.y()) - radius_)),
            last_b = std::min(cells.height - 1, cells.cell_v(std::max(from.y(), to.y()) + radius_));
  if (first_a > last_a) return;
  const Eigen::Vector3f way = (to - from).cast<float>();
  const float length2 = way.head<2>().squaredNorm(), inverse = length2 > 0 ? 1 / length2 : 0;
  const auto begin = static_cast<float>(from.z()), lowest = begin + std::min(0.0F, way.z());
  // Seen from where the way begins.
  const Eigen::Index count = last_a - first_a + 1;
  const Eigen::ArrayXf u = Eigen::ArrayXf::LinSpaced(count, static_cast<float>(cells.u(first_a) - from.x()),
                                                     static_cast<float>(cells.u(last_a) - from.x()));
  Eigen::ArrayXf share(count), heights(count);
  for (int b = first_b; b <= last_b; ++b) {
    const std::size_t at = cells.index(first_a, b);
    if (Eigen::Map<const Eigen::ArrayXf>(map_.heights.data() + at, count).maxCoeff() <= lowest) continue;
    const auto v = static_cast<float>(cells.v(b) - from.y());
    share = ((u * way.x() + v * way.y()) * inverse).max(0.0F).min(1.0F);
    heights = (u - share * way.x()).square() + (v - share * way.y()).square();  // off the axis
    // What is true of the farthest corner of a cell is true of all of it; a smaller cutter, its tip higher: of a ball
    // the sphere about the same centre.
    heights = begin + share * way.z() + (raised_ + rim_) -
              (rim_ * rim_ - (heights.sqrt() + (to_corner_ + raised_ - flat_)).max(0.0F).square()).max(0.0F).sqrt() +
              (heights - max_off2_).max(0.0F) * far_above;
    visit(at, heights);
  }
}

double StockTop::volume(const Vec3& from, const Vec3& to) const {
  double heights = 0;
  for_each_row(from, to, [&](std::size_t at, const Eigen::ArrayXf& left) {
    const Eigen::Map<const Eigen::ArrayXf> tops(map_.heights.data() + at, left.size());
    heights += static_cast<double>((tops - left).max(0.0F).sum());
  });
  return heights * map_.lattice.step * map_.lattice.step;
}

std::optional<double> StockTop::highest(const Vec3& from, const Vec3& to) const {
  float highest = no_height;
  for_each_row(from, to, [&](std::size_t at, const Eigen::ArrayXf& left) {
    for (Eigen::Index cell = 0; cell < left.size(); ++cell)
      if (const float top = map_.heights[at + static_cast<std::size_t>(cell)]; top > left[cell])
        highest = std::max(highest, top);
  });
  return highest > no_height ? std::optional(static_cast<double>(highest)) : std::nullopt;
}

double StockTop::cut(const Vec3& from, const Vec3& to) {
  double heights = 0;
  for_each_row(from, to, [&](std::size_t at, const Eigen::ArrayXf& left) {
    Eigen::Map<Eigen::ArrayXf> tops(map_.heights.data() + at, left.size());
    heights += static_cast<double>((tops - left).max(0.0F).sum());
    tops = tops.min(left);
  });
  return heights * map_.lattice.step * map_.lattice.step;
}

}  // namespace sculpt
