// Robot + tool -> bodies: what is rigidly fixed to one link, as convex pieces inside bounding capsules. Metres, in the
// link's frame.
#pragma once

#include <algorithm>
#include <vector>

#include "core/cell/cell.hpp"
#include "core/collision/shape/distance.hpp"

namespace sculpt {

/// All points within `radius_m` of a segment.
struct Capsule {
  Segment core;
  double radius_m = 0;

  /// Farthest point from the origin of the frame.
  double extent() const { return std::max(core.a.norm(), core.b.norm()) + radius_m; }
};

/// A sphere, box or cylinder, and a capsule that holds all of it.
struct Piece {
  Shape shape;
  Capsule hull;
  std::size_t covers = 0;  ///< which of its link's shapes it is, or covers a part of
};

struct Body {
  int link = -1;
  bool tool = false;  ///< ball and shank
  std::vector<Piece> pieces;
  Capsule hull;  ///< holds all pieces
};

/// A body for each link with shapes, meshes replaced by boxes that cover their triangles, then the tool on the tool
/// link.
std::vector<Body> make_bodies(const Cell& cell, const Tool& tool);

/// Of the body, what covers these shapes of its link: some of those that it has.
Body part_of(const Body& body, const std::vector<std::size_t>& shapes);

}  // namespace sculpt
