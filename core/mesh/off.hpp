// .off file -> Mesh, in the order and with the corners of the file.
#pragma once

#include <string_view>

#include "core/mesh/mesh.hpp"

namespace sculpt {

/// As text, with or without normals, colours and texture coordinates. Nothing is allocated by what the file says that
/// is not bounded by what it has. Throws InputError `mesh_unreadable`, with the line.
Mesh read_off(std::string_view bytes);

}  // namespace sculpt
