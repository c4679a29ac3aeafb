// Facets that a file gives more than once.
#pragma once

#include "core/solid/fixed_mesh.hpp"

namespace sculpt {

/// Takes out facets that have the same corners as another, half of what is there several times; false where there are
/// none. A patch of them is looked at as a whole: two bodies that touch in it are one body, so it goes; a surface that
/// was written twice stays once. A patch that is neither stays as it is. `sides`: of the mesh, sorted; not kept up.
bool halve_twins(FixedMesh& mesh, const std::vector<Side>& sides);

}  // namespace sculpt
