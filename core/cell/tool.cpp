#include "core/cell/tool.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/base/error.hpp"

namespace sculpt {
namespace {

// A little less than half a voxel: what is left is all the room that path errors have.
constexpr double max_share = 0.49;
// A cone becomes cylinders that step by this much; more of them would cost more time in every collision check.
constexpr double cone_step_m = 0.002;
constexpr int max_cone_steps = 8;

double holder_length(const ToolSpec& spec) {
  double length = 0;
  for (const HolderSection& section : spec.holder) length += section.length_m;
  return length;
}

[[noreturn]] void refuse_radius(const char* part, double radius_m, double voxel_m, bool in_voxels, int resolution) {
  std::ostringstream text;
  text << part << " radius " << radius_m << " m does not fit through a voxel of " << voxel_m << " m: it must be below "
       << max_share << " voxel edges, here " << max_share * voxel_m << " m; take a ";
  if (!in_voxels) {
    int finer = 1;  // resolutions are powers of two
    while (radius_m >= max_share * voxel_m * finer) finer *= 2;
    if (resolution >= finer)
      text << "resolution of at most " << resolution / finer << " for this size of stock, or a ";
    else
      text << "lower resolution, or a ";
  }
  text << "thinner tool in the cell file";
  throw InputError("tool_too_large", text.str());
}

}  // namespace

Tool make_tool(const ToolSpec& spec, double voxel_m, int resolution) {
  const double unit_m = spec.in_voxels ? voxel_m : 1.0;
  const Tool tool{spec.ball_radius * unit_m, spec.shank_radius * unit_m, spec.stickout_m};
  const auto check = [&](const char* part, double radius_m) {
    if (radius_m >= max_share * voxel_m) refuse_radius(part, radius_m, voxel_m, spec.in_voxels, resolution);
  };
  check("ball", tool.ball_radius_m);
  check("shank", tool.shank_radius_m);
  const double free_m = spec.stickout_m - holder_length(spec);
  if (!spec.holder.empty() && free_m <= tool.ball_radius_m) {
    std::ostringstream text;
    text << "the ball of radius " << tool.ball_radius_m << " m is not free: its centre is only " << free_m
         << " m beyond the end of the holder; take a longer stickout_m or a shorter holder in the cell file";
    throw InputError("tool_too_large", text.str());
  }
  return tool;
}

std::vector<Shape> holder_shapes(const ToolSpec& spec) {
  std::vector<Shape> shapes;
  double start_m = 0;
  for (const HolderSection& section : spec.holder) {
    const double taper_m = section.end_radius_m - section.radius_m;
    const int steps = std::clamp(static_cast<int>(std::ceil(std::abs(taper_m) / cone_step_m)), 1, max_cone_steps);
    const auto radius_at = [&](int step) { return section.radius_m + taper_m * step / steps; };
    for (int step = 0; step < steps; ++step) {
      Shape shape;
      shape.kind = ShapeKind::cylinder;
      shape.radius_m = std::max(radius_at(step), radius_at(step + 1));
      shape.length_m = section.length_m / steps;
      shape.pose.translation().z() = start_m + (step + 0.5) * shape.length_m;
      shapes.push_back(std::move(shape));
    }
    start_m += section.length_m;
  }
  return shapes;
}

}  // namespace sculpt
