// Robot + tool -> bodies: convex shapes fixed to a link, each inside a bounding capsule. Metres, in the link's frame.
#pragma once

#include <vector>

#include "core/cell/cell.hpp"
#include "core/collision/distance.hpp"

namespace sculpt {

/// A sphere, box or cylinder. `core` and `core_radius_m` are a capsule that holds all of it.
struct Body {
  int link = -1;
  Shape shape;
  Segment core;
  double core_radius_m = 0;
  bool tool = false;  ///< ball or shank
};

/// The shapes of all links, meshes replaced by boxes that cover their triangles, then the tool's ball and shank on the
/// tool link.
std::vector<Body> make_bodies(const Cell& cell, const Tool& tool);

}  // namespace sculpt
