#include "core/collision/fcl_shape.hpp"

namespace sculpt {
namespace {

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
  switch (shape.kind) {
    case ShapeKind::sphere:
      return std::make_shared<fcl::Sphered>(fcl_mm * shape.radius_m + grow);
    case ShapeKind::box:
      return std::make_shared<fcl::Boxd>(fcl_mm * shape.sides_m + Vec3::Constant(2 * grow));
    case ShapeKind::cylinder:
      return std::make_shared<fcl::Cylinderd>(fcl_mm * shape.radius_m + grow, fcl_mm * shape.length_m + 2 * grow);
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

}  // namespace sculpt
