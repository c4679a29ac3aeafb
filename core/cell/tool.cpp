#include "core/cell/tool.hpp"

#include <sstream>

#include "core/base/error.hpp"

namespace sculpt {

Tool make_tool(const ToolSpec& spec, double voxel_m) {
  // A little less than half a voxel: what is left is all the room that path errors have.
  constexpr double largest_share = 0.49;
  const double unit_m = spec.in_voxels ? voxel_m : 1.0;
  const Tool tool{spec.ball_radius * unit_m, spec.shank_radius * unit_m, spec.stickout_m};
  const auto check = [&](const char* part, double radius_m) {
    if (radius_m < largest_share * voxel_m) return;
    std::ostringstream text;
    text << part << " radius " << radius_m << " m does not fit through a voxel of " << voxel_m
         << " m: it must be below " << largest_share * voxel_m
         << " m; take a lower resolution or a thinner tool in the cell file";
    throw InputError("tool_too_large", text.str());
  };
  check("ball", tool.ball_radius_m);
  check("shank", tool.shank_radius_m);
  return tool;
}

}  // namespace sculpt
