#include "core/collision/shape/shape_tree.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "tests/core/collision/shape/random_shapes.hpp"

namespace sculpt {
namespace {

/// The node and all below it, less the root.
void for_each_below(const ShapeTree& tree, const ShapeTree::Node& node,
                    const std::function<void(const ShapeTree::Node&)>& visit) {
  for (int child = 0; child < node.children; ++child) {
    const ShapeTree::Node& below = tree.nodes[static_cast<std::size_t>(node.first_child + child)];
    visit(below);
    for_each_below(tree, below, visit);
  }
}

Shape random_shape(Random& random, ShapeKind kind) {
  Shape shape;
  shape.kind = kind;
  shape.pose = random_pose(random);
  shape.sides_m = {random.between(0.01, 0.4), random.between(0.01, 0.4), random.between(0.01, 0.4)};
  shape.radius_m = random.between(0.01, 0.2);
  shape.length_m = random.between(0.01, 0.4);
  shape.mesh = random_mesh(random, 1 + static_cast<int>(random.between(0, 60)));
  return shape;
}

TEST(ShapeTree, EveryNodeHoldsAllThatIsBelowIt) {
  for (std::uint64_t seed = 0; seed < 40; ++seed)
    for (const ShapeKind kind : {ShapeKind::sphere, ShapeKind::box, ShapeKind::cylinder, ShapeKind::mesh}) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      Random random(seed);
      const ShapeTree tree = make_tree(random_shape(random, kind));
      for (const ShapeTree::Node& node : tree.nodes) {
        for_each_below(tree, node, [&](const ShapeTree::Node& below) {
          if (!below.is_leaf()) return;
          const Convex::Corners around = node.shape.corners();
          for (int sample = 0; sample < 10; ++sample) {
            const Vec3 along = random_direction(random), point = random_point_of(below.shape, random);
            double farthest = std::numeric_limits<double>::lowest();
            for (std::size_t at = 0; at < around.count; ++at)
              farthest = std::max(farthest, along.dot(around.points[at]) + around.radius);
            ASSERT_LE(along.dot(point), farthest + 1e-9);
          }
        });
      }
    }
}

TEST(ShapeTree, EveryTriangleOfAMeshIsALeafWhereTheShapeStands) {
  Random random(5);
  const Shape shape = random_shape(random, ShapeKind::mesh);
  const ShapeTree tree = make_tree(shape);
  std::size_t leaves = 0;
  for (const ShapeTree::Node& node : tree.nodes) leaves += node.is_leaf();
  EXPECT_EQ(leaves, shape.mesh->triangles.size());
  for (const auto& [a, b, c] : shape.mesh->triangles) {
    const Vec3 corner = shape.pose * shape.mesh->vertices[b];
    EXPECT_TRUE(std::ranges::any_of(tree.nodes, [&](const ShapeTree::Node& node) {
      return node.is_leaf() && (node.shape.middle + node.shape.axes.col(0) - corner).norm() < 1e-12;
    }));
  }
}

TEST(ShapeTree, TrianglesInOneHeapAreHalvedAllTheSame) {
  Shape shape;
  shape.kind = ShapeKind::mesh;
  auto mesh = std::make_shared<Mesh>();
  mesh->vertices = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}};
  for (int copy = 0; copy < 300; ++copy) mesh->triangles.push_back({0, 1, 2});
  shape.mesh = mesh;
  EXPECT_EQ(make_tree(shape).nodes.size(), 599u);
}

}  // namespace
}  // namespace sculpt
