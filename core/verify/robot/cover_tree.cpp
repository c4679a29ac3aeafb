#include "core/verify/robot/cover_tree.hpp"

#include <algorithm>

namespace sculpt {
namespace {

// Triangles a box may hold: fewer make tighter boxes, more of them.
constexpr std::size_t max_triangles = 24;

fcl::AABBd box_around(const std::vector<CoverTree::Triangle>& triangles, std::size_t begin, std::size_t end) {
  fcl::AABBd box;
  for (std::size_t at = begin; at < end; ++at)
    for (const Vec3& corner : triangles[at]) box += corner;
  return box;
}

}  // namespace

CoverTree::CoverTree(std::vector<Triangle> triangles) {
  if (!triangles.empty()) add(triangles, 0, triangles.size());
}

// Splits at the median of the longest side until boxes hold few triangles.
int CoverTree::add(std::vector<Triangle>& triangles, std::size_t begin, std::size_t end) {
  const auto added = static_cast<int>(nodes_.size());
  const fcl::AABBd box = box_around(triangles, begin, end);
  nodes_.push_back({box.center(), (box.max_ - box.min_) / 2});
  if (end - begin <= max_triangles) {
    nodes_.back().box_number = static_cast<int>(boxes_.size());
    boxes_.push_back(box);
    return added;
  }
  Eigen::Index axis = 0;
  (box.max_ - box.min_).maxCoeff(&axis);
  const auto at = [&](std::size_t index) { return triangles.begin() + static_cast<std::ptrdiff_t>(index); };
  const std::size_t middle = begin + (end - begin) / 2;
  std::nth_element(at(begin), at(middle), at(end), [axis](const Triangle& a, const Triangle& b) {
    return a[0][axis] + a[1][axis] + a[2][axis] < b[0][axis] + b[1][axis] + b[2][axis];
  });
  const int first = add(triangles, begin, middle), second = add(triangles, middle, end);
  nodes_[static_cast<std::size_t>(added)].first = first;
  nodes_[static_cast<std::size_t>(added)].second = second;
  return added;
}

// The other tree as this one sees it, and what is asked of its boxes.
struct CoverTree::Sight {
  const CoverTree& other;
  const Frame& seen;
  double grow;
  const std::function<bool(const fcl::AABBd&)>& use;

  const Node& at(int node) const { return other.nodes_[static_cast<std::size_t>(node)]; }

  bool meets(const Node& here, const Node& there) const {
    return !fcl::obbDisjoint<double>(seen.linear(), seen * there.middle - here.middle, here.half.array() + grow,
                                     there.half);
  }

  // Whether some leaf below `there` does.
  bool meets_leaf(const Node& here, const Node& there) const {
    return meets(here, there) &&
           (there.box_number >= 0 || meets_leaf(here, at(there.first)) || meets_leaf(here, at(there.second)));
  }
};

// `others`: nodes that hold all of the other tree which may meet this node.
bool CoverTree::any_near(int node, const std::vector<int>& others, const Sight& sight) const {
  const Node& here = nodes_[static_cast<std::size_t>(node)];
  if (here.box_number >= 0)
    return std::ranges::any_of(others, [&](int other) { return sight.meets_leaf(here, sight.at(other)); }) &&
           sight.use(boxes_[static_cast<std::size_t>(here.box_number)]);
  std::vector<int> open = others, near;
  while (!open.empty()) {
    const int other = open.back();
    const Node& there = sight.at(other);
    open.pop_back();
    if (!sight.meets(here, there)) continue;
    if (there.box_number >= 0 || there.half.squaredNorm() <= here.half.squaredNorm()) {
      near.push_back(other);
    } else {
      open.push_back(there.first);
      open.push_back(there.second);
    }
  }
  return !near.empty() && (any_near(here.first, near, sight) || any_near(here.second, near, sight));
}

bool CoverTree::any_near(const CoverTree& other, const Frame& seen, double grow,
                         const std::function<bool(const fcl::AABBd&)>& use) const {
  return !nodes_.empty() && !other.nodes_.empty() && any_near(0, {0}, {other, seen, grow, use});
}

}  // namespace sculpt
