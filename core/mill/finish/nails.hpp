// Points of the part's surface, each with what still stands above it along its outward normal: the measure of finishing
// (nails, after Chappel, "The use of vectors to simulate material removed by numerically controlled milling",
// Computer-Aided Design 15, 1983).
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/material/voxel_grid.hpp"
#include "core/mesh/mesh.hpp"

namespace sculpt {

/// Stock frame, m.
struct Nail {
  Vec3 point, normal;
};

/// Not shared between threads while anything is cut.
class Nails {
 public:
  /// About `count` of them, spread evenly at random over the part's area; facets inside of the target have none, nor
  /// has the face that the part stands on. `part` in metres; its facets may be turned either way, all alike.
  Nails(const Mesh& part, const VoxelGrid& voxels, const Grid& grid, std::size_t count, std::uint64_t seed);

  std::size_t size() const { return nails_.size(); }
  const Nail& operator[](std::size_t at) const { return nails_[at]; }
  /// Upper bound of what stands above each (m): at first up to the side of the block; `uncut` where no ball came near
  /// it.
  double excess(std::size_t at) const { return static_cast<double>(excess_[at]); }
  /// Not looked at if more.
  static constexpr double farthest_m = 1e-3;
  static constexpr double uncut = std::numeric_limits<float>::max();
  /// Some tool could come to it.
  void mark_reachable(std::size_t at) { reachable_[at] = 1; }
  bool is_reachable(std::size_t at) const { return reachable_[at] != 0; }
  /// Of each whether it is, as 1 or 0.
  const std::vector<char>& reachable() const { return reachable_; }
  /// Of the surface, for each nail (m2).
  double area_m2() const { return area_m2_; }

  /// A ball's middle went straight from one place to the other.
  void cut(const Vec3& from, const Vec3& to, double radius);
  /// If it went so: calls `visit(nail, excess)` for each of those that are asked for, `asks(nail)`, above which no more
  /// than `most_m` would be left, and perhaps for others. Any thread while nothing is cut.
  template <typename Asks, typename Visit>
  void for_each_cut(const Vec3& from, const Vec3& to, double radius, double most_m, const Asks& asks,
                    const Visit& visit) const {
    for_each_near((from + to) / 2, radius + most_m + (to - from).norm() / 2, [&](std::uint32_t at) {
      if (!asks(at)) return;
      if (const auto left = excess_under(nails_[at], from, to, radius, most_m)) visit(at, *left);
    });
  }

  /// Calls `visit(number)` with all that are no farther from a place than this, and some others.
  template <typename Visit>
  void for_each_near(const Vec3& at, double reach_m, const Visit& visit) const {
    const auto first = [&](int axis, double reach) { return std::max(0, box_along(axis, at[axis] - reach)); };
    const auto last = [&](int axis, double reach) {
      return std::min(boxes_[static_cast<std::size_t>(axis)] - 1, box_along(axis, at[axis] + reach));
    };
    const auto off = [&](int axis, int box) {
      const double low = low_[axis] + box * edge_;
      return std::max({0.0, low - at[axis], at[axis] - low - edge_});
    };
    const int widest_from = first(0, reach_m), widest_to = last(0, reach_m);
    if (widest_from > widest_to) return;
    for (int k = first(2, reach_m); k <= last(2, reach_m); ++k)
      for (int j = first(1, reach_m); j <= last(1, reach_m); ++j) {
        const std::size_t row = boxes_row(j, k);
        if (begin_of(widest_from, row) == begin_of(widest_to + 1, row)) continue;
        const double off_j = off(1, j), off_k = off(2, k), left = reach_m * reach_m - off_j * off_j - off_k * off_k;
        if (left < 0) continue;
        const double along = std::sqrt(left);
        const std::uint32_t end = begin_of(std::max(last(0, along), -1) + 1, row);
        for (std::uint32_t nail = begin_of(std::min(first(0, along), boxes_[0]), row); nail < end; ++nail) visit(nail);
      }
  }

 private:
  static std::optional<double> excess_under(const Nail& nail, const Vec3& from, const Vec3& to, double radius,
                                            double most_m);
  void sort_into_boxes(const std::vector<Nail>& nails);
  /// Boxes of a row, along x, are one after the other.
  std::uint32_t begin_of(int i, std::size_t row) const { return begin_[row + static_cast<std::size_t>(i)]; }
  int box_along(int axis, double at) const { return static_cast<int>(std::floor((at - low_[axis]) / edge_)); }
  std::size_t boxes_row(int j, int k) const {
    return static_cast<std::size_t>(boxes_[0]) *
           (static_cast<std::size_t>(j) + static_cast<std::size_t>(boxes_[1]) * static_cast<std::size_t>(k));
  }

  std::vector<Nail> nails_;  ///< by box
  std::vector<float> excess_;
  std::vector<char> reachable_;
  double area_m2_ = 0, edge_ = 1;
  Vec3 low_ = Vec3::Zero();
  std::array<int, 3> boxes_{};
  std::vector<std::uint32_t> begin_;  ///< of each box
};

/// From a point along a unit direction to a ball around `middle`; negative where the point is inside of it, infinite
/// where the ball is missed or behind.
double way_to_ball(const Vec3& point, const Vec3& direction, const Vec3& middle, double radius);

}  // namespace sculpt
