// .ply file -> Mesh, in the order and with the corners of the file.
#pragma once

#include <string_view>

#include "core/mesh/mesh.hpp"

namespace sculpt {

/// Polygons ("face") and strips ("tristrips"), as text and in both byte orders. Nothing is allocated by what the file
/// says that is not bounded by what it has. Throws InputError `mesh_unreadable`, with the element and its line or byte;
/// `memory_cap` where the triangles would take more than `memory_cap_bytes`.
Mesh read_ply(std::string_view bytes, std::uint64_t memory_cap_bytes);

}  // namespace sculpt
