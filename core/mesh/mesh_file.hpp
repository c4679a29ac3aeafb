// Mesh file -> Mesh. The only door to assimp.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/watch.hpp"
#include "core/mesh/mesh.hpp"

namespace sculpt {

/// Bytes of memory that `load_mesh` is predicted to need for a file of this size and kind ("stl", "obj", "ply", "gltf",
/// "glb"...). Throws InputError `mesh_unreadable` for a kind that is not known.
std::uint64_t predict_mesh_memory(std::uint64_t file_bytes, const std::string& extension);

/// All sub-meshes of the file with their node transforms applied; polygons become triangles, degenerate triangles are
/// dropped. `bytes`: the file's content; `extension`: its kind, lower case without dot. Throws InputError:
/// `mesh_unreadable` (no mesh), `mesh_empty` (no triangle), `mesh_not_finite` (NaN or infinite vertex), `memory_cap`
/// (prediction over the cap); Cancelled.
Mesh load_mesh(std::string_view bytes, const std::string& extension, std::uint64_t memory_cap_bytes,
               const Watch& watch);

}  // namespace sculpt
