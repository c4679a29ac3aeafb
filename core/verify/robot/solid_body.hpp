// Link shapes for the replay, as FCL geometry. Internal to verify/. Millimetres: FCL's tolerances are absolute and made
// for that size.
#pragma once

#include <fcl/fcl.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "core/cell/robot.hpp"
#include "core/verify/robot/cover_tree.hpp"

namespace sculpt {

using SolidMesh = fcl::BVHModel<fcl::OBBRSSd>;

/// One shape of a link. Meshes are their surface: what is wholly inside one does not touch it.
struct SolidBody {
  int link = -1;
  ShapeKind kind = ShapeKind::box;
  Frame pose = Frame::Identity();  ///< of the shape's frame in the link; its box is centred there (also for meshes)
  Vec3 half = Vec3::Zero();        ///< half sides of the box around the shape, in the shape's frame
  double radius = 0;               ///< of the sphere around that box or shape
  std::shared_ptr<const SolidMesh> mesh;
  CoverTree cover;  ///< of a mesh, in the shape's frame
};

/// `poses`: of the links. Of the shape's frame, then.
inline Frame pose_of(const SolidBody& body, const std::vector<Frame>& poses) {
  return poses[static_cast<std::size_t>(body.link)] * body.pose;
}

std::vector<SolidBody> make_solid_bodies(const Robot& robot);

bool solids_touch(const fcl::CollisionGeometryd& a, const Frame& pose_a, const fcl::CollisionGeometryd& b,
                  const Frame& pose_b);

/// Calls `use(geometry, pose)` for a box that is grown to all sides.
template <typename Use>
bool use_box(const fcl::AABBd& box, double grow, Use&& use) {
  return use(fcl::Boxd(box.max_ - box.min_ + Vec3::Constant(2 * grow)), Frame(Eigen::Translation3d(box.center())));
}

/// Calls `use(geometry, pose in the shape's frame)` for geometry that holds all points within `grow` of the body, until
/// it returns true; returns whether it did. Meshes are themselves if `grow` is 0, else their cover.
template <typename Use>
bool any_part(const SolidBody& body, double grow, Use&& use) {
  const Frame here = Frame::Identity();
  switch (body.kind) {
    case ShapeKind::sphere:
      return use(fcl::Sphered(body.half.x() + grow), here);
    case ShapeKind::cylinder:
      return use(fcl::Cylinderd(body.half.x() + grow, 2 * (body.half.z() + grow)), here);
    case ShapeKind::box:
      return use(fcl::Boxd(2 * (body.half + Vec3::Constant(grow))), here);
    case ShapeKind::mesh:
      break;
  }
  if (grow == 0) return use(*body.mesh, here);
  return std::ranges::any_of(body.cover.boxes(), [&](const fcl::AABBd& box) { return use_box(box, grow, use); });
}

}  // namespace sculpt
