// Shapes at random as bodies, and their distance as FCL measures it, which shares nothing with trees and planes.
#pragma once

#include "core/collision/shape/body.hpp"
#include "core/collision/shape/fcl_shape.hpp"
#include "tests/core/collision/shape/random_shapes.hpp"

namespace sculpt {

inline Body body_of(const Shape& shape) {
  return {0, false, {{std::make_shared<const ShapeTree>(make_tree(shape)), 0}}};
}

inline Shape random_shape(Random& random) {
  Shape shape;
  const auto kind = static_cast<int>(random.between(0, 5));
  shape.kind = kind == 0   ? ShapeKind::sphere
               : kind == 1 ? ShapeKind::box
               : kind == 2 ? ShapeKind::cylinder
                           : ShapeKind::mesh;
  shape.pose = random_pose(random, 0.1);
  shape.sides_m = {random.between(0.01, 0.4), random.between(0.01, 0.4), random.between(0.01, 0.4)};
  shape.radius_m = random.between(0.01, 0.2);
  shape.length_m = random.between(0.01, 0.4);
  if (shape.kind == ShapeKind::mesh) shape.mesh = random_mesh(random, 1 + static_cast<int>(random.between(0, 80)));
  return shape;
}

class FclPair {
 public:
  FclPair(const Shape& first, const Shape& second)
      : first_(make_fcl_geometry(first, 0)),
        second_(make_fcl_geometry(second, 0)),
        first_in_link_(first.pose),
        second_in_link_(second.pose) {}

  /// Of the two, their links standing there; 0 where they touch.
  double distance_m(const Frame& first_link, const Frame& second_link) const {
    const Frame at = to_fcl(first_link * first_in_link_), other_at = to_fcl(second_link * second_in_link_);
    return fcl_touch(*first_, at, *second_, other_at) ? 0 : fcl_distance_mm(*first_, at, *second_, other_at) / fcl_mm;
  }

 private:
  decltype(make_fcl_geometry(Shape{}, 0)) first_, second_;
  Frame first_in_link_, second_in_link_;
};

}  // namespace sculpt
