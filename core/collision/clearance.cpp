#include "core/collision/clearance.hpp"

#include <algorithm>
#include <utility>

namespace sculpt {
namespace {

using Node = ShapeTree::Node;

constexpr int finest_stock = 5;  // levels below the grid's cube

double extent(const Node& node) {
  return node.is_leaf() ? -1 : node.shape.extent();
}

/// Calls `visit(node, placed)` for the children of a node of `tree`, placed by `pose`, until it returns true.
template <typename Visit>
bool any_child(const ShapeTree& tree, const Node& node, const Frame& pose, const Visit& visit) {
  for (int child = 0; child < node.children; ++child) {
    const Node& below = tree.nodes[static_cast<std::size_t>(node.first_child + child)];
    if (visit(below, below.shape.placed(pose))) return true;
  }
  return false;
}

/// Goes down two trees at once, in the frame of the second one.
class TreePair {
 public:
  TreePair(const ShapeTree& first, const Frame& pose, const ShapeTree& second, const Vec3& slide)
      : first_(first), pose_(pose), second_(second), slide_(slide) {}

  bool within(double reach) const {
    return within(first_.root(), first_.root().shape.placed(pose_), second_.root(), reach);
  }

 private:
  bool within(const Node& one, const Convex& placed, const Node& other, double reach) const {
    const bool to_decide = one.is_leaf() && other.is_leaf();
    const Separation plane = separate(placed, other.shape, std::nextafter(reach, 1e9), effort(to_decide));
    if (plane.gap - std::abs(plane.normal.dot(slide_)) > reach) return false;
    if (to_decide) return true;
    if (extent(one) >= extent(other))
      return any_child(first_, one, pose_,
                       [&](const Node& child, const Convex& at) { return within(child, at, other, reach); });
    for (int child = 0; child < other.children; ++child)
      if (within(one, placed, second_.nodes[static_cast<std::size_t>(other.first_child + child)], reach)) return true;
    return false;
  }

  const ShapeTree& first_;
  const Frame& pose_;
  const ShapeTree& second_;
  Vec3 slide_;
};

/// Goes down a body's tree and the octree of the standing voxels at once.
class MaterialQuery {
 public:
  MaterialQuery(const ShapeTree& tree, const Frame& pose, const Material& material, const Grid& grid, double reach_m)
      : tree_(tree), pose_(pose), material_(material), grid_(grid), reach_m_(reach_m) {}

  bool is_near() const { return is_near(tree_.root(), tree_.root().shape.placed(pose_), {0, 0, 0}, grid_.n); }

 private:
  bool is_near(const Node& node, const Convex& placed, Voxel corner, int size) const {
    if (!material_.any_in(corner, size)) return false;
    const bool is_full = material_.is_full(corner, size), to_decide = node.is_leaf() && is_full;
    const Vec3 half = Vec3::Constant(grid_.voxel_m * size / 2);
    const Vec3 middle = grid_.origin_m + grid_.voxel_m * Vec3(corner.i, corner.j, corner.k) + half;
    const Vec3 to_node = placed.centre() - middle;
    const double radius_m = placed.extent();
    if (to_node.cwiseAbs().maxCoeff() > half.x() + radius_m + reach_m_) return false;
    const Convex cube = Convex::box(Frame(Eigen::Translation3d(middle)), half);
    if (separate(placed, cube, std::nextafter(reach_m_, 1e9), effort(to_decide)).gap > reach_m_) return false;
    if (to_decide) return true;
    if (is_full || (!node.is_leaf() && radius_m >= half.norm()))
      return any_child(tree_, node, pose_,
                       [&](const Node& child, const Convex& at) { return is_near(child, at, corner, size); });
    // The nearest eighth first.
    const int nearest = (to_node.x() > 0 ? 1 : 0) | (to_node.y() > 0 ? 2 : 0) | (to_node.z() > 0 ? 4 : 0);
    for (int part = 0; part < 8; ++part) {
      const int child = part ^ nearest;
      if (is_near(node, placed, corner + Voxel{child & 1, child >> 1 & 1, child >> 2} * (size / 2), size / 2))
        return true;
    }
    return false;
  }

  const ShapeTree& tree_;
  const Frame& pose_;
  const Material& material_;
  const Grid& grid_;
  double reach_m_;
};

/// What stands below a cube of the material's, under `node`.
void add_cubes(ShapeTree& tree, std::size_t node, const Material& material, const Grid& grid, Voxel corner, int size) {
  Frame middle = Frame::Identity();
  const Vec3 half = Vec3::Constant(size / 2.0);
  middle.translation() = grid.origin_m + grid.voxel_m * (Vec3(corner.i, corner.j, corner.k) + half);
  tree.nodes[node].shape = Convex::box(middle, grid.voxel_m * half);
  if (material.is_full(corner, size) || size <= std::max(1, grid.n >> finest_stock)) return;
  std::vector<Voxel> standing;
  for (int child = 0; child < 8; ++child) {
    const Voxel below = corner + Voxel{child & 1, child >> 1 & 1, child >> 2} * (size / 2);
    if (material.any_in(below, size / 2)) standing.push_back(below);
  }
  const std::size_t first = tree.nodes.size();
  tree.nodes[node].first_child = static_cast<int>(first);
  tree.nodes[node].children = static_cast<int>(standing.size());
  tree.nodes.resize(first + standing.size());
  for (std::size_t child = 0; child < standing.size(); ++child)
    add_cubes(tree, first + child, material, grid, standing[child], size / 2);
}

}  // namespace

double hull_distance(const Body& a, const Frame& pose_a, const Body& b, const Frame& pose_b) {
  const auto placed = [](const Frame& pose, const Segment& core) { return Segment{pose * core.a, pose * core.b}; };
  return distance(placed(pose_a, a.hull.core), placed(pose_b, b.hull.core)) - a.hull.radius_m - b.hull.radius_m;
}

bool near_body(const Body& a, const Frame& pose_a, const Body& b, const Frame& pose_b, double reach_m) {
  return hull_distance(a, pose_a, b, pose_b) <= reach_m &&
         near_sliding_body(a, pose_a, Vec3::Zero(), b, pose_b, reach_m);
}

bool near_sliding_body(const Body& a, const Frame& pose_a, const Vec3& slide, const Body& b, const Frame& pose_b,
                       double reach_m) {
  const Frame pose = pose_b.inverse() * pose_a;
  for (const Body::Part& of_a : a.parts)
    for (const Body::Part& of_b : b.parts)
      if (TreePair(*of_a.tree, pose, *of_b.tree, slide).within(reach_m)) return true;
  return false;
}

bool near_material(const Body& body, const Frame& pose, const Material& material, const Grid& grid, double reach_m) {
  return std::ranges::any_of(body.parts, [&](const Body::Part& part) {
    return MaterialQuery(*part.tree, pose, material, grid, reach_m).is_near();
  });
}

Body make_stock_body(const Material& material, const Grid& grid, int stock_link) {
  ShapeTree tree;
  tree.nodes.emplace_back();
  add_cubes(tree, 0, material, grid, {0, 0, 0}, grid.n);
  return {stock_link, false, {{std::make_shared<const ShapeTree>(std::move(tree)), 0}}};
}

}  // namespace sculpt
