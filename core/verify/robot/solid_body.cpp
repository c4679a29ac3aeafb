#include "core/verify/robot/solid_body.hpp"

#include <algorithm>
#include <numeric>

#include "core/verify/findings/slack.hpp"

namespace sculpt {
namespace {

void add_mesh(const Mesh& source, SolidBody& body) {
  std::vector<CoverTree::Triangle> triangles;
  fcl::AABBd box;
  for (const auto& corners : source.triangles) {
    triangles.push_back(
        {mm * source.vertices[corners[0]], mm * source.vertices[corners[1]], mm * source.vertices[corners[2]]});
    for (const Vec3& corner : triangles.back()) box += corner;
  }
  const Vec3 centre = box.center();
  body.pose.translate(centre);
  body.half = (box.max_ - box.min_) / 2;
  for (CoverTree::Triangle& triangle : triangles)
    for (Vec3& corner : triangle) corner -= centre;
  const auto mesh = std::make_shared<SolidMesh>();
  mesh->beginModel(static_cast<int>(triangles.size()));
  for (const CoverTree::Triangle& triangle : triangles) mesh->addTriangle(triangle[0], triangle[1], triangle[2]);
  mesh->endModel();
  body.mesh = mesh;
  body.cover = CoverTree(std::move(triangles));
}

SolidBody make_solid_body(const Shape& shape, int link) {
  SolidBody body;
  body.link = link;
  body.kind = shape.kind;
  body.pose = shape.pose;
  body.pose.translation() *= mm;
  switch (shape.kind) {
    case ShapeKind::sphere:
      body.half = Vec3::Constant(mm * shape.radius_m);
      break;
    case ShapeKind::box:
      body.half = mm * shape.sides_m / 2;
      break;
    case ShapeKind::cylinder:
      body.half = mm * Vec3(shape.radius_m, shape.radius_m, shape.length_m / 2);
      break;
    case ShapeKind::mesh:
      add_mesh(*shape.mesh, body);
      break;
  }
  body.radius = body.half.norm();
  if (shape.kind == ShapeKind::sphere) body.radius = body.half.x();
  if (shape.kind == ShapeKind::cylinder) body.radius = std::hypot(body.half.x(), body.half.z());
  return body;
}

}  // namespace

std::vector<SolidBody> make_solid_bodies(const Robot& robot) {
  std::vector<SolidBody> bodies;
  for (std::size_t link = 0; link < robot.links.size(); ++link)
    for (const Shape& shape : robot.links[link].shapes)
      if (shape.kind != ShapeKind::mesh || !shape.mesh->triangles.empty())
        bodies.push_back(make_solid_body(shape, static_cast<int>(link)));
  return bodies;
}

bool solids_touch(const fcl::CollisionGeometryd& a, const Frame& pose_a, const fcl::CollisionGeometryd& b,
                  const Frame& pose_b) {
  fcl::CollisionRequestd request(1, false);
  request.gjk_solver_type = fcl::GST_LIBCCD;
  fcl::CollisionResultd result;
  return fcl::collide(&a, pose_a, &b, pose_b, request, result) > 0;
}

}  // namespace sculpt
