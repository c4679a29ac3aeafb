// What a small glTF file could do to assimp's reader, refused before it is read.
#pragma once

#include <string>
#include <string_view>

namespace sculpt {

/// Looks at the JSON of a "gltf" or "glb" file; does nothing for other extensions. Throws InputError `mesh_unreadable`
/// for JSON or chains of nodes so deep that a recursive reader runs out of stack, and for nodes with several parents
/// (11 levels of ten make 10^11 copies).
void check_gltf(std::string_view bytes, const std::string& extension);

}  // namespace sculpt
