// What stands still beside the stock in its own frame, as triangles: table, clamps, the post under it.
#pragma once

#include "core/cell/cell.hpp"
#include "core/mesh/mesh.hpp"

namespace sculpt {

/// Shapes of the links that are fixed to the stock link (m, stock frame). Round ones are replaced by prisms that hold
/// them, spheres by boxes.
Mesh fixture_mesh(const Cell& cell);

}  // namespace sculpt
