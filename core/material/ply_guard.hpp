// What assimp's reader of .ply cannot take, refused before it is read.
#pragma once

#include <string>
#include <string_view>

namespace sculpt {

/// Looks at the header of a "ply" file; does nothing for other extensions. Throws InputError `mesh_unreadable` for one
/// that is not as the format says (Turk, "The PLY Polygon File Format"): assimp looks for its end for ever or reads
/// beyond the file; and for more elements than the file has bytes.
void check_ply(std::string_view bytes, const std::string& extension);

}  // namespace sculpt
