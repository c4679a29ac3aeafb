// The part's surface, and how near a moving cutter comes to it. Internal to verify/. Millimetres, stock frame.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/cell/milling/mill_tool.hpp"
#include "core/mesh/mesh.hpp"

namespace sculpt {

/// Triangles by the boxes of a coarse grid that they lie in. Not shared between threads.
class SurfaceGrid {
 public:
  /// `part` in metres.
  explicit SurfaceGrid(const Mesh& part);

  /// How deep the surface is inside a cutter that goes straight from one tip to the other (mm; `axis` towards the
  /// spindle): 0 or less if it stays out by so much, as far as `enough_mm`.
  double depth(const Cutter& cutter, const Vec3& axis, const Vec3& from, const Vec3& to, double enough_mm);

 private:
  using Corners = std::array<Vec3, 3>;
  /// Numbers of those whose boxes meet this one, each once.
  const std::vector<std::uint32_t>& within(const Eigen::AlignedBox3d& around);
  std::array<int, 3> box_of(const Vec3& point) const;
  template <typename Visit>
  void for_each_box(const Eigen::AlignedBox3d& around, const Visit& visit) const;

  /// Around a triangle.
  struct Ball {
    Vec3 middle;
    double radius;
  };

  std::vector<Corners> triangles_;
  std::vector<Ball> balls_;
  Vec3 low_ = Vec3::Zero();
  double edge_ = 1;
  std::array<int, 3> boxes_{};
  std::vector<std::uint32_t> begin_, numbers_;  ///< of each box: its part of `numbers_`
  std::vector<std::uint32_t> seen_, found_;
  std::uint32_t search_ = 0;
};

}  // namespace sculpt
