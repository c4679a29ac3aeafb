// Shapes as coloured triangles, to be drawn.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/cell/robot.hpp"

namespace sculpt {

using Colour = std::array<std::uint8_t, 3>;

struct Facet {
  std::array<Vec3, 3> corners;  ///< m
  Colour colour;
  std::optional<Vec3> normal = {};  ///< unit vector that the light falls on as if it were the surface's
};

/// Adds the surface of a shape whose link is at `pose`; round ones as prisms of 24 sides.
void add_facets(const Shape& shape, const Frame& pose, const Colour& colour, std::vector<Facet>& facets);

}  // namespace sculpt
