// How close a certified motion may come: what is left for the errors of double arithmetic and of the decoded file.
#pragma once

namespace sculpt {

inline constexpr double link_margin_m = 2e-4;        ///< of links, holder and spindle, to everything
inline constexpr double tool_margin_voxels = 0.005;  ///< of ball and shank, to everything but the voxel they cut

}  // namespace sculpt
