// The faces of a mesh file -> triangles.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "core/mesh/mesh.hpp"

namespace sculpt {

/// Adds a polygon as a fan from the corner from which it is seen whole, else from its first: then some triangles are
/// turned the other way and take off what others add too much. Fewer than 3 corners add nothing.
void add_polygon(std::span<const std::uint32_t> corners, Mesh& mesh);

/// A number as text files of meshes have it, "nan" and "inf" included; beyond what a double holds it is infinite.
std::optional<double> parse_coordinate(std::string_view word);

}  // namespace sculpt
