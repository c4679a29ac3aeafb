#include "core/collision/body_pairs.hpp"

#include <gtest/gtest.h>

#include "core/collision/margins.hpp"

namespace sculpt {
namespace {

Body body_of(int link, std::size_t shapes) {
  std::vector<Body::Part> parts;
  for (std::size_t at = 0; at < shapes; ++at) {
    Shape ball;
    ball.kind = ShapeKind::sphere;
    ball.radius_m = 0.1;
    parts.push_back({std::make_shared<const ShapeTree>(make_tree(ball)), at});
  }
  return {link, false, std::move(parts)};
}

std::vector<std::size_t> shapes_of(const Body& body) {
  std::vector<std::size_t> shapes;
  for (const Body::Part& part : body.parts) shapes.push_back(part.shape);
  return shapes;
}

using Shapes = std::vector<std::size_t>;

TEST(BodyPairs, WholeBodiesWhereAllShapesAreKeptApart) {
  std::vector<Body> bodies{body_of(4, 2), body_of(7, 1)};
  const auto pairs = pair_bodies(bodies, 0, 1, {{4, 7}, {{0, 0}, {1, 0}}, link_margin_m});
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].first, 0u);
  EXPECT_EQ(pairs[0].second, 1u);
  EXPECT_EQ(pairs[0].margin_m, link_margin_m);
  EXPECT_EQ(bodies.size(), 2u) << "no parts are needed";
}

TEST(BodyPairs, PartsWhereSomeShapesMayTouchTogetherWithTheirLikes) {
  std::vector<Body> bodies{body_of(4, 3), body_of(7, 2)};
  // The first shape may touch the second link's second; the others are kept apart from all of it.
  const auto pairs = pair_bodies(bodies, 0, 1, {{4, 7}, {{0, 0}, {1, 0}, {1, 1}, {2, 0}, {2, 1}}, link_margin_m});
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(shapes_of(bodies[pairs[0].first]), Shapes{0});
  EXPECT_EQ(shapes_of(bodies[pairs[0].second]), Shapes{0});
  EXPECT_EQ(shapes_of(bodies[pairs[1].first]), (Shapes{1, 2}));
  EXPECT_EQ(pairs[1].second, 1u);
  EXPECT_EQ(bodies[pairs[0].first].link, 4);
  EXPECT_EQ(bodies[pairs[0].second].link, 7);
}

TEST(BodyPairs, TheMarginIsAShareOfASmallGapAndWholeWhereThereIsNone) {
  std::vector<Body> bodies{body_of(4, 1), body_of(7, 1)};
  EXPECT_DOUBLE_EQ(pair_bodies(bodies, 0, 1, {{4, 7}, {{0, 0}}, 1e-4})[0].margin_m, 0.6e-4);
  EXPECT_EQ(pair_bodies(bodies, 0, 1, {{4, 7}, {{0, 0}}, 0})[0].margin_m, link_margin_m);
}

}  // namespace
}  // namespace sculpt
