// .dae file -> Mesh, as makers of robots give them: what the scene shows, in metres.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/mesh/mesh.hpp"

namespace sculpt {

/// Triangles, polylists and polygons of all geometries that the file's scene has, where its nodes place them, in
/// metres by its `<unit>`. Coordinates are the file's: they are not turned by its `<up_axis>`, as URDFs mean it. Skins
/// and what lies in other files are left out. (assimp 5.2 hangs or crashes on broken ones.) Throws InputError
/// `mesh_unreadable`, with the line, `memory_cap` where nodes show more than fits.
Mesh read_collada(std::string_view bytes, std::uint64_t memory_cap_bytes);

}  // namespace sculpt
