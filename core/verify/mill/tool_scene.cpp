#include "core/verify/mill/tool_scene.hpp"

#include <algorithm>

namespace sculpt {
namespace {

constexpr int cone_steps = 8;

Shape rod(double radius_m, double from_m, double to_m, double stickout_m) {
  Shape shape;
  shape.kind = ShapeKind::cylinder;
  shape.radius_m = radius_m;
  shape.length_m = to_m - from_m;
  shape.pose.translation().z() = stickout_m - (from_m + to_m) / 2;  // heights count from the tip, z from the link
  return shape;
}

/// The body of a tool, cones as rods that hold them.
std::vector<Shape> body_of(const MillTool& tool) {
  std::vector<Shape> shapes;
  double height = tool.cutter.flute_m;
  for (const HolderSection& section : tool.body) {
    const int steps = section.radius_m == section.end_radius_m ? 1 : cone_steps;
    for (int step = 0; step < steps; ++step) {
      const auto radius = [&](int at) {
        return section.radius_m + (section.end_radius_m - section.radius_m) * at / steps;
      };
      const double from = height + section.length_m * step / steps, to = height + section.length_m * (step + 1) / steps;
      shapes.push_back(rod(std::max(radius(step), radius(step + 1)), from, to, tool.stickout_m));
    }
    height += section.length_m;
  }
  return shapes;
}

/// A ball cutter ends in a ball; of others the round of the rim is filled up.
std::vector<Shape> cutter_of(const MillTool& tool) {
  const Cutter& cutter = tool.cutter;
  if (cutter.kind != CutterKind::ball) return {rod(cutter.radius_m, 0, cutter.flute_m, tool.stickout_m)};
  Shape ball;
  ball.kind = ShapeKind::sphere;
  ball.radius_m = cutter.radius_m;
  ball.pose.translation().z() = tool.stickout_m - cutter.radius_m;
  std::vector<Shape> shapes{ball};
  if (cutter.flute_m > cutter.radius_m)
    shapes.push_back(rod(cutter.radius_m, cutter.radius_m, cutter.flute_m, tool.stickout_m));
  return shapes;
}

}  // namespace

ToolScene::ToolScene(const Cell& base, const MillTool& the_tool, const std::vector<int>& joints,
                     const StandingVoxels& material)
    : tool(the_tool),
      cell(base),
      motion(cell.robot, joints, cell.rest, cell.stock_link),
      chain(motion.chain(cell.stock_link, cell.tool_link)) {
  auto& shapes = cell.robot.links[static_cast<std::size_t>(cell.tool_link)].shapes;
  for (Shape& shape : body_of(tool)) shapes.push_back(std::move(shape));
  bodies = make_solid_bodies(cell.robot);
  pairs = choose_pairs(cell, joints, motion, bodies);
  for (Shape& shape : cutter_of(tool)) shapes.push_back(std::move(shape));
  whole_bodies = make_solid_bodies(cell.robot);
  whole_pairs = choose_pairs(cell, joints, motion, whole_bodies);
  links.emplace(cell, motion, bodies, pairs.checked, material);
  whole.emplace(cell, motion, whole_bodies, whole_pairs.checked, material);
}

}  // namespace sculpt
