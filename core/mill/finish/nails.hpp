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

  /// So many of them are wanted on a square of the stepover.
  static constexpr double a_stepover = 2;

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
  /// Of all nails, as `excess` has it.
  const std::vector<float>& excesses() const { return excess_; }
  /// What a cut changed: of which nail, and what stood above it.
  struct Change {
    std::uint32_t nail;
    float before, after;
  };
  /// If a ball's middle went so: lowers the excesses that some nails would have, and adds these to `changes`. Any
  /// thread while nothing is cut.
  void cut(const Vec3& from, const Vec3& to, double radius, std::vector<float>& excesses,
           std::vector<Change>& changes) const;

  /// Calls `visit(number)` with all that are in the boxes around a place, those within `reach_m` and some others.
  template <typename Visit>
  void for_each_near(const Vec3& at, double reach_m, const Visit& visit) const {
    for_each_in(at - Vec3::Constant(reach_m), at + Vec3::Constant(reach_m), visit);
  }

 private:
  void sort_into_boxes(const std::vector<Nail>& nails);
  template <typename Visit>
  void for_each_in(const Vec3& low, const Vec3& high, const Visit& visit) const {
    std::array<int, 3> first{}, last{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto box = [&](const Vec3& point) {
        return static_cast<int>(std::floor((point[static_cast<int>(axis)] - low_[static_cast<int>(axis)]) / edge_));
      };
      first[axis] = std::max(0, box(low));
      last[axis] = std::min(boxes_[axis] - 1, box(high));
    }
    for (int k = first[2]; k <= last[2]; ++k)
      for (int j = first[1]; j <= last[1]; ++j) {
        const std::size_t row = boxes_row(j, k);
        if (first[0] > last[0]) continue;
        // Boxes of a row are one after the other.
        const std::uint32_t end = begin_[row + static_cast<std::size_t>(last[0]) + 1];
        for (std::uint32_t at = begin_[row + static_cast<std::size_t>(first[0])]; at < end; ++at) visit(at);
      }
  }
  std::size_t boxes_row(int j, int k) const {
    return static_cast<std::size_t>(boxes_[0]) *
           (static_cast<std::size_t>(j) + static_cast<std::size_t>(boxes_[1]) * static_cast<std::size_t>(k));
  }

  std::vector<Nail> nails_;  ///< by box
  std::vector<float> excess_;
  std::vector<Change> changes_;  ///< by the last cut
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
