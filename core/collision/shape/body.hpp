// Robot + tool -> bodies: what is rigidly fixed to one link, as trees of convex shapes. Metres, in the link's frame.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "core/cell/cell.hpp"
#include "core/collision/shape/distance.hpp"
#include "core/collision/shape/shape_tree.hpp"

namespace sculpt {

/// All points within `radius_m` of a segment.
struct Capsule {
  Segment core;
  double radius_m = 0;
};

struct Body {
  int link = -1;
  bool tool = false;  ///< ball and shank
  struct Part {
    std::shared_ptr<const ShapeTree> tree;
    std::size_t shape = 0;  ///< which of its link's shapes it is
  };
  std::vector<Part> parts;
  Capsule hull;         ///< holds all parts
  double extent_m = 0;  ///< no point is farther from the origin of the link's frame

  /// Of one shape each: hull and extent follow.
  Body(int link, bool tool, std::vector<Part> parts);
};

/// A body for each link with shapes, then the tool on the tool link.
std::vector<Body> make_bodies(const Cell& cell, const Tool& tool);

/// Of the body, these shapes of its link: some of those that it has.
Body part_of(const Body& body, const std::vector<std::size_t>& shapes);

}  // namespace sculpt
