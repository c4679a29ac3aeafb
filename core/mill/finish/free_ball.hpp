// Where a ball is clear of the part, whatever carries it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <unsupported/Eigen/BVH>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace sculpt {

/// Stock frame, m. Immutable; any thread.
class FreeBall {
 public:
  explicit FreeBall(const Mesh& part);

  /// The middle moved until no facet is nearer than `radius`: again and again straight away from the nearest one
  /// (alternating projections; Bauschke and Borwein, SIAM Review 38, 1996). Nothing where that finds no end, as between
  /// walls that leave no room.
  std::optional<Vec3> push_out(Vec3 middle, double radius) const;

 private:
  using Corners = std::array<Vec3, 3>;

  std::optional<Vec3> nearest(const Vec3& to, double within) const;

  std::vector<Corners> facets_;
  Eigen::KdBVH<double, 3, std::uint32_t> tree_;
};

}  // namespace sculpt
