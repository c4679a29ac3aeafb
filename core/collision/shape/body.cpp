#include "core/collision/shape/body.hpp"

namespace sculpt {
namespace {

Body::Part make_part(ShapeTree tree, std::size_t shape) {
  return {std::make_shared<const ShapeTree>(std::move(tree)), shape};
}

/// Around a root: boxes along their longest side.
Capsule capsule_around(const Convex& shape) {
  Eigen::Index longest = 0;
  shape.half.maxCoeff(&longest);
  const Vec3 along = shape.axes.col(longest) * shape.half[longest];
  Vec3 across = shape.half;
  across[longest] = 0;
  return {{shape.middle - along, shape.middle + along}, across.norm() + shape.radius};
}

/// A capsule around all: along the line between the two of their ends that are farthest apart.
Capsule capsule_around(const std::vector<Body::Part>& parts) {
  std::vector<Capsule> all;
  for (const Body::Part& part : parts) {
    const Convex& root = part.tree->root().shape;
    all.push_back(
        capsule_around(root.kind == Convex::Kind::triangle ? Convex::sphere(root.centre(), root.extent()) : root));
  }
  if (all.size() == 1) return all.front();
  std::vector<Vec3> ends;
  for (const Capsule& capsule : all) ends.insert(ends.end(), {capsule.core.a, capsule.core.b});
  Capsule hull{{ends[0], ends[0]}, 0};
  for (const Vec3& a : ends)
    for (const Vec3& b : ends)
      if ((a - b).norm() > (hull.core.a - hull.core.b).norm()) hull.core = {a, b};
  for (const Capsule& capsule : all)
    for (const Vec3& end : {capsule.core.a, capsule.core.b})
      hull.radius_m = std::max(hull.radius_m, distance(hull.core, {end, end}) + capsule.radius_m);
  return hull;
}

/// Farthest from the origin, as the leaves have it.
double extent_of(const ShapeTree& tree) {
  double extent = 0;
  for (const ShapeTree::Node& node : tree.nodes) {
    if (!node.is_leaf()) continue;
    const Convex::Corners corners = node.shape.corners();
    for (std::size_t at = 0; at < corners.count; ++at)
      extent = std::max(extent, corners.points[at].norm() + corners.radius);
  }
  return extent;
}

std::vector<Body::Part> make_parts(const std::vector<Shape>& shapes) {
  std::vector<Body::Part> parts;
  for (std::size_t at = 0; at < shapes.size(); ++at) parts.push_back(make_part(make_tree(shapes[at]), at));
  return parts;
}

std::vector<Body::Part> make_parts(const Tool& tool) {
  const Vec3 ball(0, 0, tool.stickout_m);
  std::vector<Body::Part> parts{make_part({{{Convex::sphere(ball, tool.ball_radius_m)}}}, 0)};
  if (tool.shank_radius_m <= 0) return parts;
  Shape shank;
  shank.kind = ShapeKind::cylinder;
  shank.radius_m = tool.shank_radius_m;
  shank.length_m = tool.stickout_m;
  shank.pose.translation() = ball / 2;
  parts.push_back(make_part(make_tree(shank), 1));
  return parts;
}

}  // namespace

Body::Body(int of_link, bool of_tool, std::vector<Part> of_parts)
    : link(of_link), tool(of_tool), parts(std::move(of_parts)), hull(capsule_around(parts)) {
  for (const Part& part : parts) extent_m = std::max(extent_m, extent_of(*part.tree));
}

std::vector<Body> make_bodies(const Cell& cell, const Tool& tool) {
  std::vector<Body> bodies;
  for (int link = 0; link < static_cast<int>(cell.robot.links.size()); ++link)
    if (auto parts = make_parts(cell.robot.links[static_cast<std::size_t>(link)].shapes); !parts.empty())
      bodies.emplace_back(link, false, std::move(parts));
  bodies.emplace_back(cell.tool_link, true,
                      cell.tool.is_guided_by_maps() ? make_parts(cell.tool.body) : make_parts(tool));
  return bodies;
}

Body part_of(const Body& body, const std::vector<std::size_t>& shapes) {
  std::vector<Body::Part> parts;
  for (const Body::Part& part : body.parts)
    if (std::ranges::find(shapes, part.shape) != shapes.end()) parts.push_back(part);
  return {body.link, body.tool, std::move(parts)};
}

}  // namespace sculpt
