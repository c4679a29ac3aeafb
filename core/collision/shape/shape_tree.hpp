// A collision shape as a tree of convex shapes: coarse ones to rule it out, exact ones to decide by.
#pragma once

#include <vector>

#include "core/cell/robot.hpp"
#include "core/collision/shape/convex.hpp"

namespace sculpt {

/// A node holds all that is below it; a leaf is exactly a part of the shape. The leaves of a mesh are its triangles.
struct ShapeTree {
  struct Node {
    Convex shape;
    int first_child = -1;  ///< -1: a leaf
    int children = 0;      ///< they lie side by side

    bool is_leaf() const { return first_child < 0; }
  };
  std::vector<Node> nodes;  ///< the root first

  const Node& root() const { return nodes.front(); }
};

/// Metres, in the frame of the shape's link.
ShapeTree make_tree(const Shape& shape);

}  // namespace sculpt
