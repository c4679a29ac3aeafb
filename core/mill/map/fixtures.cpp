#include "core/mill/map/fixtures.hpp"

#include <cmath>
#include <numbers>

#include "core/collision/link_pairs.hpp"

namespace sculpt {
namespace {

constexpr int prism_sides = 32;

/// A prism over a polygon in the plane z = -half .. half.
void add_prism(Mesh& mesh, const std::vector<Eigen::Vector2d>& polygon, double half, const Frame& pose) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size()),
             count = static_cast<std::uint32_t>(polygon.size());
  for (const double z : {-half, half})
    for (const Eigen::Vector2d& corner : polygon) mesh.vertices.push_back(pose * Vec3(corner.x(), corner.y(), z));
  for (std::uint32_t at = 0; at < count; ++at) {
    const std::uint32_t next = (at + 1) % count, low = first + at, beside = first + next;
    mesh.triangles.push_back({low, beside, beside + count});
    mesh.triangles.push_back({low, beside + count, low + count});
    if (at == 0 || next == 0) continue;
    mesh.triangles.push_back({first, beside, low});
    mesh.triangles.push_back({first + count, low + count, beside + count});
  }
}

void add_box(Mesh& mesh, const Vec3& half, const Frame& pose) {
  add_prism(mesh, {{-half.x(), -half.y()}, {half.x(), -half.y()}, {half.x(), half.y()}, {-half.x(), half.y()}},
            half.z(), pose);
}

void add_shape(Mesh& mesh, const Shape& shape, const Frame& link) {
  const Frame pose = link * shape.pose;
  switch (shape.kind) {
    case ShapeKind::sphere:
      return add_box(mesh, Vec3::Constant(shape.radius_m), pose);
    case ShapeKind::box:
      return add_box(mesh, shape.sides_m / 2, pose);
    case ShapeKind::cylinder: {
      std::vector<Eigen::Vector2d> polygon;
      const double around = shape.radius_m / std::cos(std::numbers::pi / prism_sides);
      for (int side = 0; side < prism_sides; ++side) {
        const double turn = 2 * std::numbers::pi * side / prism_sides;
        polygon.emplace_back(around * std::cos(turn), around * std::sin(turn));
      }
      return add_prism(mesh, polygon, shape.length_m / 2, pose);
    }
    case ShapeKind::mesh: {
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      for (const Vec3& vertex : shape.mesh->vertices) mesh.vertices.push_back(pose * vertex);
      for (const auto& triangle : shape.mesh->triangles)
        mesh.triangles.push_back({triangle[0] + first, triangle[1] + first, triangle[2] + first});
    }
  }
}

}  // namespace

Mesh fixture_mesh(const Cell& cell) {
  const std::vector<int> group = rigid_groups(cell.robot);
  const Chain chain = cell.chain();
  std::vector<Frame> poses;
  chain.link_poses(cell.home(chain), poses);  // in the stock frame
  Mesh mesh;
  for (std::size_t link = 0; link < group.size(); ++link)
    if (group[link] == group[static_cast<std::size_t>(cell.stock_link)])
      for (const Shape& shape : cell.robot.links[link].shapes) add_shape(mesh, shape, poses[link]);
  return mesh;
}

}  // namespace sculpt
