// A surface as triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/frame.hpp"

namespace sculpt {

/// Triangles over shared vertices; units are the file's own until `place_mesh` made them metres.
struct Mesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

}  // namespace sculpt
