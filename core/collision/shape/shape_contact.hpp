// Do two shapes of a cell touch at a configuration, and is there one at which they do not.
#pragma once

#include <memory>
#include <vector>

#include "core/cell/chain.hpp"
#include "core/collision/shape/fcl_shape.hpp"

namespace sculpt {

/// Shapes that are no farther apart than this count as touching (m).
inline constexpr double touching_m = 2e-5;

/// One collision shape of a link. The shape must outlive it.
struct LinkShape {
  LinkShape(int of_link, const Shape& of_shape);

  int link;
  const Shape* shape;
  std::shared_ptr<fcl::CollisionGeometryd> geometry;
  Frame box;        ///< axes and middle of a box around the shape, in the link's frame
  Vec3 half_sides;  ///< of that box (m)

  /// No point of the shape is farther from the origin of the link's frame (m).
  double extent() const { return box.translation().norm() + half_sides.norm(); }
  /// Half of the smallest side of the box (m).
  double half_thickness() const { return half_sides.minCoeff(); }
};

/// Two shapes of links that `chain` moves against each other. All three must outlive this.
class ShapeContact {
 public:
  ShapeContact(const Chain& chain, const LinkShape& first, const LinkShape& second);

  /// Are they within `reach_m` of each other at q? With less than 0: do they still touch when the first one is so much
  /// smaller on all sides?
  bool touch(const Configuration& q, double reach_m = touching_m) const;

  /// Coordinates of the chain that move the two against each other.
  const std::vector<int>& coordinates() const { return coordinates_; }

  /// Is it proved that they touch wherever the coordinates stand within their limits, those that do not matter as in q?
  /// Boxes of joint values in which what the joints move is less than how deep the two are in each other.
  bool always_touch(const Configuration& q) const;

  /// Was a configuration found at which they do not touch? Looks along each joint through q and in the planes of two
  /// joints, then at random and uphill from the best that was seen. Deterministic.
  bool come_apart(const Configuration& q) const;

 private:
  bool covered(const Configuration& low, const Configuration& high, int& boxes_left) const;
  double apartness(const Configuration& q) const;
  bool climb(Configuration q) const;

  const Chain& chain_;
  const LinkShape *first_, *second_;  // the first one is no mesh if one of them is none
  double thickness_m_;                // how much smaller the first one can be made
  Configuration speed_;               // motion_bound of the first one, seen from the second
  std::vector<int> coordinates_;
};

}  // namespace sculpt
