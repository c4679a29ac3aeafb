// The part's facets as a tool sees them along its axis, and where a ball with a rod above it may be among them.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/mesh/mesh.hpp"
#include "core/mill/map/tool_frame.hpp"

namespace sculpt {

/// Exact, unlike height maps: a ball end of `radius` and the endless rod of the same radius above it against triangles.
/// Coordinates of the tool's frame, m; a place is that of the ball's middle. Immutable; any thread.
class FacetColumns {
 public:
  /// `part` must outlive the object.
  FacetColumns(const Mesh& part, const ToolFrame& frame);

  /// Memory that it holds.
  std::size_t bytes() const;

  /// The lowest the ball may be over (u, v), or `from` where that is higher: facets below it are not looked at. Where
  /// it is above `enough`, any height above that which it may not be below.
  double rest_height(double u, double v, double radius, double from,
                     double enough = std::numeric_limits<double>::infinity()) const;

  /// Does it stay farther than `radius` from all facets on its straight way, the rod above it as well?
  bool is_clear(const Vec3& from, const Vec3& to, double radius) const;

 private:
  using Triangle = std::array<Vec3, 3>;
  /// A facet as a cell lists it: what is around it in plan, and its top, rounded outwards (m, in plan from the corner
  /// of the first cell).
  struct Listed {
    float low_u, high_u, low_v, high_v, top;
    std::uint32_t facet;
  };
  class PlanWay;
  void list_facets();
  Listed listed(std::uint32_t facet) const;
  Triangle corners(std::uint32_t facet) const {
    const auto& [a, b, c] = part_.triangles[facet];
    return {vertices_[a], vertices_[b], vertices_[c]};
  }
  double rest_on(std::uint32_t facet, double u, double v, double radius, double height) const;
  template <typename Visit>
  void for_each_cell(double low_u, double high_u, double low_v, double high_v, const Visit& visit) const;

  const Mesh& part_;
  std::vector<Vec3> vertices_, normals_;  ///< tool frame; of facets: unit, not downwards
  double low_u_ = 0, low_v_ = 0, step_ = 1;
  int width_ = 0, height_ = 0;
  std::vector<std::uint32_t> begin_;  ///< of each cell: its part of `listed_`
  std::vector<Listed> listed_;        ///< of each cell, the highest first
};

}  // namespace sculpt
