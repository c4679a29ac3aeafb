// Which search plans a job.
#pragma once

#include <string_view>

namespace sculpt {

/// Of arms `sweep` or `octree`; translating robots carve by `octree`, also where `sweep` is asked for, or by `voxel`;
/// `mill` with milling tools.
enum class Search { sweep, octree, voxel, mill };

/// "sweep", "octree", "voxel", "mill".
const char* name(Search search);

/// Throws InputError `search_unknown`.
Search parse_search(std::string_view text);

}  // namespace sculpt
