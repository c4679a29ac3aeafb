// Facets that a file gives more than once.
#pragma once

#include "core/material/fixed_mesh.hpp"

namespace sculpt {

/// Without facets that have the same corners as another. A patch of them is looked at as a whole: two bodies that touch
/// in it are one body, so it goes; a surface that was written twice stays once. A patch that is neither stays as it is.
FixedMesh drop_twins(FixedMesh mesh);

}  // namespace sculpt
