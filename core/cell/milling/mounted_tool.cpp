#include "core/cell/milling/mounted_tool.hpp"

namespace sculpt {
namespace {

constexpr double next_to_nothing_m = 1e-6;

}  // namespace

std::vector<Shape> tool_shapes(const MillTool& tool) {
  // holder_shapes goes from the link outwards, a tool's body from the cutter upwards.
  ToolSpec spec;
  spec.holder.push_back({tool.cutter.flute_m, tool.cutter.radius_m, tool.cutter.radius_m});
  spec.holder.insert(spec.holder.end(), tool.body.begin(), tool.body.end());
  std::vector<Shape> shapes = holder_shapes(spec);
  for (Shape& shape : shapes) shape.pose.translation().z() = tool.stickout_m - shape.pose.translation().z();
  return shapes;
}

ToolSpec tip_of(const MillTool& tool) {
  ToolSpec spec;
  spec.ball_radius = next_to_nothing_m;
  spec.shank_radius = 0;
  spec.in_voxels = false;
  spec.stickout_m = tool.stickout_m;
  return spec;
}

Cell carrying(const Cell& cell, const MillTool& tool) {
  Cell with = cell;
  with.tool = tip_of(tool);
  // The tip itself stands for the ball of a thin tool.
  for (Shape& shape : tool_shapes(tool))
    with.robot.links[static_cast<std::size_t>(cell.tool_link)].shapes.push_back(std::move(shape));
  return with;
}

}  // namespace sculpt
