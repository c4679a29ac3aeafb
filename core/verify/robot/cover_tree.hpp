// Boxes that hold the triangles of a mesh, in a tree. Internal to verify/. Millimetres, the mesh's frame.
#pragma once

#include <fcl/fcl.h>

#include <array>
#include <functional>
#include <vector>

#include "core/cell/robot.hpp"

namespace sculpt {

/// Immutable after construction.
class CoverTree {
 public:
  using Triangle = std::array<Vec3, 3>;

  CoverTree() = default;
  explicit CoverTree(std::vector<Triangle> triangles);

  /// The smallest ones; each holds up to 24 triangles.
  const std::vector<fcl::AABBd>& boxes() const { return boxes_; }

  /// Calls `use` for those of `boxes()` that, grown by `grow` to all sides, meet some of the other's, until it returns
  /// true; returns whether it did. `seen`: the other one's frame in this one's. What is in none of them is farther than
  /// `grow` from the other mesh.
  bool any_near(const CoverTree& other, const Frame& seen, double grow,
                const std::function<bool(const fcl::AABBd&)>& use) const;

 private:
  struct Node {
    Vec3 middle, half;    ///< of its box
    int box_number = -1;  ///< of a leaf
    int first = -1, second = -1;
  };
  struct Sight;

  int add(std::vector<Triangle>& triangles, std::size_t begin, std::size_t end);
  bool any_near(int node, const std::vector<int>& others, const Sight& sight) const;

  std::vector<Node> nodes_;  ///< the first one holds all
  std::vector<fcl::AABBd> boxes_;
};

}  // namespace sculpt
