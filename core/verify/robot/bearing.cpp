#include "core/verify/robot/bearing.hpp"

#include <algorithm>
#include <cmath>

#include "core/verify/robot/body_depth.hpp"

namespace sculpt {
namespace {

constexpr double touch_mm = 0.02;
constexpr double meet_mm = 1;
constexpr double same_place_mm = 1e-6;

struct Ray {
  Vec3 start, way;
};

// Where along the ray it goes through the triangle, if it does: its start seen from the three edges.
std::optional<double> crossing(const Ray& ray, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 from_a = a - ray.start, from_b = b - ray.start, from_c = c - ray.start;
  const double opposite_a = ray.way.dot(from_b.cross(from_c)), opposite_b = ray.way.dot(from_c.cross(from_a)),
               opposite_c = ray.way.dot(from_a.cross(from_b)), all = opposite_a + opposite_b + opposite_c;
  const bool outside =
      std::min({opposite_a, opposite_b, opposite_c}) < 0 && std::max({opposite_a, opposite_b, opposite_c}) > 0;
  if (outside || all == 0) return std::nullopt;
  return ray.way.dot(opposite_a * from_a + opposite_b * from_b + opposite_c * from_c) / all;
}

// How far along the line a body is left or entered, in order; for meshes only.
std::vector<double> crossings(const SolidBody& body, const std::vector<Frame>& poses, const Ray& line) {
  std::vector<double> found;
  if (body.kind != ShapeKind::mesh) return found;
  const Frame into = pose_of(body, poses).inverse();
  const Ray local{into * line.start, into.linear() * line.way};
  for (int at = 0; at < body.mesh->num_tris; ++at) {
    const fcl::Triangle& corners = body.mesh->tri_indices[at];
    const auto corner = [&](int which) { return body.mesh->vertices[corners[which]]; };
    if (const auto place = crossing(local, corner(0), corner(1), corner(2))) found.push_back(*place);
  }
  std::sort(found.begin(), found.end());
  // Through an edge or a corner it goes once, whatever number of triangles meet there.
  found.erase(std::unique(found.begin(), found.end(), [](double a, double b) { return b - a < same_place_mm; }),
              found.end());
  return found;
}

bool comes_near(const SolidBody& body, const std::vector<Frame>& poses, const Vec3& point) {
  const Frame pose = pose_of(body, poses);
  const fcl::Sphered probe(meet_mm);
  return any_part(body, 0, [&](const fcl::CollisionGeometryd& part, const Frame& at) {
    return solids_touch(part, pose * at, probe, Frame(Eigen::Translation3d(point)));
  });
}

bool is_odd_before(const std::vector<double>& crossings, double place) {
  return (std::lower_bound(crossings.begin(), crossings.end(), place) - crossings.begin()) % 2 == 1;
}

}  // namespace

bool touch(const SolidBody& a, const SolidBody& b, const std::vector<Frame>& poses) {
  if (a.kind == ShapeKind::mesh && b.kind != ShapeKind::mesh) return touch(b, a, poses);
  const Frame at = pose_of(a, poses), other = pose_of(b, poses);
  if ((at.translation() - other.translation()).norm() > a.radius + b.radius + touch_mm) return false;
  if (a.kind == ShapeKind::mesh) {
    fcl::DistanceResultd result;
    return fcl::distance(a.mesh.get(), at, b.mesh.get(), other, fcl::DistanceRequestd(), result) <= touch_mm;
  }
  return any_part(a, touch_mm, [&](const fcl::CollisionGeometryd& grown, const Frame&) {
    return any_part(
        b, 0, [&](const fcl::CollisionGeometryd& part, const Frame&) { return solids_touch(grown, at, part, other); });
  });
}

bool meet_at_joint(const SolidBody& a, const SolidBody& b, const MovingJoint& joint, const std::vector<Frame>& poses) {
  const Frame& pose = poses[static_cast<std::size_t>(joint.link)];
  const Ray axis{pose.translation(), pose.linear() * joint.axis};
  const std::vector<double> of_a = crossings(a, poses, axis), of_b = crossings(b, poses, axis);
  const auto meet = [&](double place) {
    const Vec3 point = axis.start + place * axis.way;
    return (is_odd_before(of_a, place) || comes_near(a, poses, point)) &&
           (is_odd_before(of_b, place) || comes_near(b, poses, point));
  };
  if (!joint.turns) return meet(0);
  const SolidBody& smaller = a.radius < b.radius ? a : b;
  const double middle = axis.way.dot(pose_of(smaller, poses).translation() - axis.start);
  const int steps = static_cast<int>(std::ceil(smaller.radius / meet_mm)) + 1;
  for (int step = -steps; step <= steps; ++step)
    if (meet(middle + step * meet_mm)) return true;
  return false;
}

std::optional<Vec3> contact_point(const SolidBody& a, const SolidBody& b, const std::vector<Frame>& poses) {
  if (a.kind == ShapeKind::mesh || b.kind == ShapeKind::mesh) return std::nullopt;
  fcl::CollisionRequestd request(1, true);
  request.gjk_solver_type = fcl::GST_LIBCCD;
  fcl::CollisionResultd result;
  any_part(a, touch_mm, [&](const fcl::CollisionGeometryd& grown, const Frame&) {
    return any_part(b, 0, [&](const fcl::CollisionGeometryd& part, const Frame&) {
      return fcl::collide(&grown, pose_of(a, poses), &part, pose_of(b, poses), request, result) > 0;
    });
  });
  if (result.numContacts() == 0) return std::nullopt;
  return result.getContact(0).pos;
}

bool holds_point(const SolidBody& body, const std::vector<Frame>& poses, const Vec3& point) {
  return body.kind != ShapeKind::mesh && depth_in(body, pose_of(body, poses).inverse() * point) >= -meet_mm;
}

}  // namespace sculpt
