#include "core/collision/shape/fcl_shape.hpp"

#include <algorithm>

namespace sculpt {
namespace {

constexpr double min_mm = 1e-3;

std::shared_ptr<fcl::CollisionGeometryd> make_bvh(const Mesh& mesh) {
  std::vector<fcl::Vector3d> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) vertices.push_back(fcl_mm * v);
  std::vector<fcl::Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
  model->addSubModel(vertices, triangles);
  model->endModel();
  return model;
}

}  // namespace

std::shared_ptr<fcl::CollisionGeometryd> make_fcl_geometry(const Shape& shape, double grow_m) {
  const double grow = fcl_mm * grow_m;
  const auto grown = [&](double length_m, double by) { return std::max(fcl_mm * length_m + by, min_mm); };
  const Vec3& sides = shape.sides_m;
  switch (shape.kind) {
    case ShapeKind::sphere:
      return std::make_shared<fcl::Sphered>(grown(shape.radius_m, grow));
    case ShapeKind::box:
      return std::make_shared<fcl::Boxd>(grown(sides.x(), 2 * grow), grown(sides.y(), 2 * grow),
                                         grown(sides.z(), 2 * grow));
    case ShapeKind::cylinder:
      return std::make_shared<fcl::Cylinderd>(grown(shape.radius_m, grow), grown(shape.length_m, 2 * grow));
    case ShapeKind::mesh:
      return make_bvh(*shape.mesh);
  }
  return nullptr;
}

bool fcl_touch(const fcl::CollisionGeometryd& a, const Frame& pose_a, const fcl::CollisionGeometryd& b,
               const Frame& pose_b) {
  fcl::CollisionRequestd request;
  request.gjk_solver_type = fcl::GST_LIBCCD;
  fcl::CollisionResultd result;
  return fcl::collide(&a, pose_a, &b, pose_b, request, result) > 0;
}

double fcl_distance_mm(const fcl::CollisionGeometryd& a, const Frame& pose_a, const fcl::CollisionGeometryd& b,
                       const Frame& pose_b) {
  const fcl::DistanceRequestd request;
  fcl::DistanceResultd result;
  return fcl::distance(&a, pose_a, &b, pose_b, request, result);
}

}  // namespace sculpt
