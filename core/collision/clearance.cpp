#include "core/collision/clearance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/collision/shape/fcl_shape.hpp"

namespace sculpt {
namespace {

constexpr std::size_t max_separations = 8;

Capsule placed(const Frame& pose, const Capsule& capsule) {
  return {{pose * capsule.core.a, pose * capsule.core.b}, capsule.radius_m};
}

bool near(const Capsule& a, const Capsule& b, double reach_m) {
  return distance(a.core, b.core) <= a.radius_m + b.radius_m + reach_m;
}

/// From the box that a piece is, or that a cylinder fits into, to the core of `hull`: a capsule may hold a flat one
/// badly.
Vec3 separation_from_piece_box(const Piece& piece, const Frame& pose, const Capsule& hull) {
  const Shape& shape = piece.shape;
  const Vec3 half =
      shape.kind == ShapeKind::box ? Vec3(shape.sides_m / 2) : Vec3(shape.radius_m, shape.radius_m, shape.length_m / 2);
  const Eigen::Matrix3d turn = pose.linear().lazyProduct(shape.pose.linear());
  const Vec3 middle = pose * shape.pose.translation();
  const Segment core{turn.transpose() * (hull.core.a - middle), turn.transpose() * (hull.core.b - middle)};
  return turn * separation_from_box(core, -half, half);
}

double distance_to_piece_box(const Piece& piece, const Frame& pose, const Capsule& hull) {
  if (piece.shape.kind == ShapeKind::sphere) return 0;
  return separation_from_piece_box(piece, pose, hull).norm() - hull.radius_m;
}

double between(const Capsule& a, const Capsule& b) {
  return distance(a.core, b.core) - a.radius_m - b.radius_m;
}

/// Lower bound of the distance between two pieces; looks no closer once it knows that it is `enough`.
double least_distance(const Piece& a, const Frame& pose_a, const Piece& b, const Frame& pose_b, double enough_m) {
  const Capsule hull_a = placed(pose_a, a.hull), hull_b = placed(pose_b, b.hull);
  double least = between(hull_a, hull_b);
  if (least < enough_m) least = std::max(least, distance_to_piece_box(a, pose_a, hull_b));
  if (least < enough_m) least = std::max(least, distance_to_piece_box(b, pose_b, hull_a));
  return least;
}

bool near_piece(const Piece& a, const Frame& pose_a, const Piece& b, const Frame& pose_b, double reach_m) {
  if (least_distance(a, pose_a, b, pose_b, std::nextafter(reach_m, 1.0)) > reach_m) return false;
  return fcl_touch(*make_fcl_geometry(a.shape, reach_m), to_fcl(pose_a * a.shape.pose), *make_fcl_geometry(b.shape, 0),
                   to_fcl(pose_b * b.shape.pose));
}

/// Half sides of the axis-aligned box around a placed sphere, box or cylinder.
Vec3 half_extents(const Shape& shape, const Eigen::Matrix3d& turn) {
  switch (shape.kind) {
    case ShapeKind::sphere:
      return Vec3::Constant(shape.radius_m);
    case ShapeKind::cylinder: {
      const Vec3 axis = turn.col(2);
      const Vec3 across = (Vec3::Ones() - axis.cwiseAbs2()).cwiseMax(0).cwiseSqrt();
      return axis.cwiseAbs() * shape.length_m / 2 + across * shape.radius_m;
    }
    default:
      return turn.cwiseAbs() * shape.sides_m / 2;
  }
}

/// `hull` in voxel edges from the corner of voxel (0,0,0).
Capsule in_voxels(const Capsule& hull, const Grid& grid) {
  const double h = grid.voxel_m;
  return {{(hull.core.a - grid.origin_m) / h, (hull.core.b - grid.origin_m) / h}, hull.radius_m / h};
}

bool piece_near_material(const Piece& piece, const Frame& link_pose, const Material& material, const Grid& grid,
                         double reach_m) {
  const double h = grid.voxel_m;
  const Capsule hull = in_voxels(placed(link_pose, piece.hull), grid);
  const double radius = hull.radius_m + reach_m / h;
  if (!material.meets_capsule(hull.core, radius, {})) return false;
  const Frame pose = link_pose * piece.shape.pose;
  const Vec3 half = half_extents(piece.shape, pose.linear()) + Vec3::Constant(reach_m);
  const Vec3 middle = pose.translation() - grid.origin_m;
  const Eigen::AlignedBox3d around((middle - half) / h, (middle + half) / h);
  const auto grown = make_fcl_geometry(piece.shape, reach_m);
  return material.any_cube([&](Voxel corner, int size) {
    const Vec3 low(corner.i, corner.j, corner.k), side = Vec3::Constant(size);
    if (!around.intersects(Eigen::AlignedBox3d(low, low + side))) return false;
    if (distance_to_box(hull.core, low, low + side) > radius) return false;
    const fcl::Boxd block(fcl_mm * h * side);
    Frame at = Frame::Identity();
    at.translation() = fcl_mm * (grid.origin_m + h * (low + side / 2));
    return fcl_touch(*grown, to_fcl(pose), block, at);
  });
}

}  // namespace

bool near_body(const Body& a, const Frame& pose_a, const Body& b, const Frame& pose_b, double reach_m) {
  if (!near(placed(pose_a, a.hull), placed(pose_b, b.hull), reach_m)) return false;
  for (const Piece& of_a : a.pieces)
    for (const Piece& of_b : b.pieces)
      if (near_piece(of_a, pose_a, of_b, pose_b, reach_m)) return true;
  return false;
}

double least_distance(const Body& a, const Frame& pose_a, const Body& b, const Frame& pose_b, double enough_m) {
  const Capsule hull_a = placed(pose_a, a.hull), hull_b = placed(pose_b, b.hull);
  if (between(hull_a, hull_b) >= enough_m) return enough_m;
  double least = enough_m;
  std::vector<const Piece*> of_b;  // those that matter
  for (const Piece& piece : b.pieces)
    if (between(hull_a, placed(pose_b, piece.hull)) < enough_m) of_b.push_back(&piece);
  for (const Piece& piece : a.pieces) {
    if (between(placed(pose_a, piece.hull), hull_b) >= least) continue;
    for (const Piece* other : of_b) least = std::min(least, least_distance(piece, pose_a, *other, pose_b, least));
  }
  return std::max(least, 0.0);
}

std::optional<std::vector<Separation>> separations(const Body& a, const Frame& pose_a, const Body& b,
                                                   const Frame& pose_b, double enough_m) {
  std::vector<Separation> found;
  const Capsule hull_a = placed(pose_a, a.hull), hull_b = placed(pose_b, b.hull);
  if (between(hull_a, hull_b) >= enough_m) return found;
  for (const Piece& of_a : a.pieces) {
    const Capsule hull = placed(pose_a, of_a.hull);
    if (between(hull, hull_b) >= enough_m) continue;
    for (const Piece& of_b : b.pieces) {
      const Capsule other = placed(pose_b, of_b.hull);
      Vec3 way = separation(hull.core, other.core);
      double gap = way.norm() - hull.radius_m - other.radius_m;
      if (gap >= enough_m) continue;
      if (of_b.shape.kind != ShapeKind::sphere) {
        const Vec3 from_box = separation_from_piece_box(of_b, pose_b, hull);
        if (from_box.norm() - hull.radius_m > gap) {
          way = from_box;
          gap = from_box.norm() - hull.radius_m;
        }
      }
      if (gap >= enough_m || distance_to_piece_box(of_a, pose_a, other) >= enough_m) continue;
      if (gap <= 0 || found.size() == max_separations) return std::nullopt;
      found.push_back({hull, way.normalized(), gap});
    }
  }
  return found;
}

std::optional<std::vector<Separation>> separations_from_grid(const Body& body, const Frame& pose, const Grid& grid,
                                                             double enough_m) {
  std::vector<Separation> found;
  const Vec3 high_m = grid.origin_m + Vec3::Constant(grid.n * grid.voxel_m);
  for (const Piece& piece : body.pieces) {
    const Capsule hull = placed(pose, piece.hull);
    const Vec3 way = separation_from_box(hull.core, grid.origin_m, high_m);
    const double gap = way.norm() - hull.radius_m;
    if (gap >= enough_m) continue;
    if (gap <= 0 || found.size() == max_separations) return std::nullopt;
    found.push_back({hull, way.normalized(), gap});
  }
  return found;
}

double least_distance_to_grid(const Body& body, const Frame& pose, const Grid& grid) {
  double least = std::numeric_limits<double>::max();
  const Vec3 high_m = grid.origin_m + Vec3::Constant(grid.n * grid.voxel_m);
  for (const Piece& piece : body.pieces) {
    const Capsule hull = placed(pose, piece.hull);
    least = std::min(least, distance_to_box(hull.core, grid.origin_m, high_m) - hull.radius_m);
  }
  return std::max(least, 0.0);
}

bool near_material(const Body& body, const Frame& pose, const Material& material, const Grid& grid, double reach_m) {
  const Capsule hull = in_voxels(placed(pose, body.hull), grid);
  if (!material.meets_capsule(hull.core, hull.radius_m + reach_m / grid.voxel_m, {})) return false;
  for (const Piece& piece : body.pieces)
    if (piece_near_material(piece, pose, material, grid, reach_m)) return true;
  return false;
}

}  // namespace sculpt
