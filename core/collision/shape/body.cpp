#include "core/collision/shape/body.hpp"

#include <algorithm>
#include <numeric>

namespace sculpt {
namespace {

constexpr std::size_t max_boxes_a_mesh = 32;

Piece make_piece(const Shape& shape) {
  Vec3 half = Vec3::Zero();
  double radius = shape.radius_m;
  if (shape.kind == ShapeKind::cylinder) half.z() = shape.length_m / 2;
  if (shape.kind == ShapeKind::box) {
    int longest = 0;
    shape.sides_m.maxCoeff(&longest);
    Vec3 rest = shape.sides_m / 2;
    half[longest] = rest[longest];
    rest[longest] = 0;
    radius = rest.norm();
  }
  return {shape, {{shape.pose * Vec3(-half), shape.pose * half}, radius}, 0};
}

/// A capsule around all pieces: along the line between the two of their ends that are farthest apart.
Capsule make_hull(const std::vector<Piece>& pieces) {
  if (pieces.size() == 1) return pieces.front().hull;
  std::vector<Vec3> ends;
  for (const Piece& piece : pieces) {
    ends.push_back(piece.hull.core.a);
    ends.push_back(piece.hull.core.b);
  }
  Capsule hull{{ends[0], ends[0]}, 0};
  for (const Vec3& a : ends)
    for (const Vec3& b : ends)
      if ((a - b).norm() > (hull.core.a - hull.core.b).norm()) hull.core = {a, b};
  for (const Piece& piece : pieces)
    for (const Vec3& end : {piece.hull.core.a, piece.hull.core.b})
      hull.radius_m = std::max(hull.radius_m, distance(hull.core, {end, end}) + piece.hull.radius_m);
  return hull;
}

/// A run of triangle indices and the box around them.
struct Cluster {
  std::vector<std::size_t> triangles;
  Eigen::AlignedBox3d box;
};

Cluster make_cluster(const Mesh& mesh, std::vector<std::size_t> triangles) {
  Cluster cluster{std::move(triangles), {}};
  for (std::size_t t : cluster.triangles)
    for (std::uint32_t v : mesh.triangles[t]) cluster.box.extend(mesh.vertices[v]);
  return cluster;
}

/// Halves the cluster at the median of its triangles' centres along its longest side.
std::pair<Cluster, Cluster> split(const Mesh& mesh, Cluster cluster) {
  int axis = 0;
  cluster.box.sizes().maxCoeff(&axis);
  const auto centre = [&](std::size_t t) {
    double sum = 0;
    for (std::uint32_t v : mesh.triangles[t]) sum += mesh.vertices[v][axis];
    return sum;
  };
  auto& all = cluster.triangles;
  std::stable_sort(all.begin(), all.end(), [&](std::size_t a, std::size_t b) { return centre(a) < centre(b); });
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  return {make_cluster(mesh, {all.begin(), middle}), make_cluster(mesh, {middle, all.end()})};
}

std::vector<Eigen::AlignedBox3d> cover_mesh(const Mesh& mesh) {
  std::vector<std::size_t> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::vector<Cluster> clusters{make_cluster(mesh, all)};
  while (clusters.size() < max_boxes_a_mesh) {
    const auto largest = std::max_element(clusters.begin(), clusters.end(), [](const Cluster& a, const Cluster& b) {
      return (a.triangles.size() > 1 ? a.box.volume() : 0) < (b.triangles.size() > 1 ? b.box.volume() : 0);
    });
    if (largest->triangles.size() < 2) break;
    auto [low, high] = split(mesh, std::move(*largest));
    *largest = std::move(low);
    clusters.push_back(std::move(high));
  }
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const Cluster& cluster : clusters) boxes.push_back(cluster.box);
  return boxes;
}

Shape box_shape(const Frame& frame, const Eigen::AlignedBox3d& box) {
  Shape shape;
  shape.kind = ShapeKind::box;
  shape.pose = frame * Eigen::Translation3d(box.center());
  shape.sides_m = box.sizes();
  return shape;
}

std::vector<Piece> make_pieces(const Link& link) {
  std::vector<Piece> pieces;
  const auto add = [&](const Shape& shape, std::size_t covers) {
    pieces.push_back(make_piece(shape));
    pieces.back().covers = covers;
  };
  for (std::size_t at = 0; at < link.shapes.size(); ++at) {
    const Shape& shape = link.shapes[at];
    if (shape.kind != ShapeKind::mesh) {
      add(shape, at);
      continue;
    }
    for (const Eigen::AlignedBox3d& box : cover_mesh(*shape.mesh)) add(box_shape(shape.pose, box), at);
  }
  return pieces;
}

std::vector<Piece> make_pieces(const Tool& tool) {
  Shape ball;
  ball.kind = ShapeKind::sphere;
  ball.radius_m = tool.ball_radius_m;
  ball.pose.translation().z() = tool.stickout_m;
  if (tool.shank_radius_m <= 0) return {make_piece(ball)};
  Shape shank;
  shank.kind = ShapeKind::cylinder;
  shank.radius_m = tool.shank_radius_m;
  shank.length_m = tool.stickout_m;
  shank.pose.translation().z() = tool.stickout_m / 2;
  return {make_piece(ball), make_piece(shank)};
}

}  // namespace

std::vector<Body> make_bodies(const Cell& cell, const Tool& tool) {
  std::vector<Body> bodies;
  const auto add = [&](int link, bool is_tool, std::vector<Piece> pieces) {
    if (pieces.empty()) return;
    const Capsule hull = make_hull(pieces);
    bodies.push_back({link, is_tool, std::move(pieces), hull});
  };
  for (int link = 0; link < static_cast<int>(cell.robot.links.size()); ++link)
    add(link, false, make_pieces(cell.robot.links[static_cast<std::size_t>(link)]));
  add(cell.tool_link, true, make_pieces(tool));
  return bodies;
}

Body part_of(const Body& body, const std::vector<std::size_t>& shapes) {
  Body part{body.link, body.tool, {}, {}};
  for (const Piece& piece : body.pieces)
    if (std::find(shapes.begin(), shapes.end(), piece.covers) != shapes.end()) part.pieces.push_back(piece);
  part.hull = make_hull(part.pieces);
  return part;
}

}  // namespace sculpt
