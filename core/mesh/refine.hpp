// A mesh -> the same surface in smaller triangles.
#pragma once

#include <cstddef>

#include "core/mesh/mesh.hpp"

namespace sculpt {

/// Halves edges that are longer than `edge` (in the mesh's unit, above 0) until none is, or there are `enough`
/// triangles. Neighbours halve the edge that they share in the same vertex, so what was closed stays closed; vertices
/// keep their numbers, new ones follow.
Mesh refine(Mesh mesh, double edge, std::size_t enough);

}  // namespace sculpt
