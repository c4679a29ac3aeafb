// Tiny glTF files of one tetrahedron with corners at 0, x, y, z.
#pragma once

#include <string>

namespace sculpt::gltf_files {

/// A .gltf with its buffer as a data URI, or naming `uri` instead. `nodes`: the JSON array of nodes; node 0 is the
/// root.
std::string embedded(const std::string& nodes, const std::string& uri = "");
/// The same as .glb.
std::string binary(const std::string& nodes);
/// A .glb whose first coordinate is not a number.
std::string binary_with_nan();

}  // namespace sculpt::gltf_files
