// A placed convex shape against axis-aligned cubes, in closed form. Internal to verify/. Millimetres.
#pragma once

#include <fcl/fcl.h>

#include <optional>

#include "core/base/frame.hpp"

namespace sculpt {

enum class Meeting { apart, meet, unknown };

class ConvexProbe {
 public:
  /// A sphere, capsule, cylinder or box of FCL's; nothing for other geometry.
  static std::optional<ConvexProbe> of(const fcl::CollisionGeometryd& geometry, const Frame& pose);

  /// Of a cube with this middle and half a side. Touching counts as meeting. `unknown` only for cylinders, near their
  /// rims.
  Meeting with_cube(const Vec3& centre, double half) const;

 private:
  /// All points within `radius` of the segment from `from` on by `way`.
  struct Capsule {
    Vec3 from, way;
    double radius;

    bool meets(const Vec3& centre, double half) const;
  };
  struct Box {
    Frame pose;  ///< of its middle
    Vec3 half;
    Eigen::Matrix3d turn;  ///< the pose's rotation without signs, grown by what rounding may take from it
    bool meets(const Vec3& centre, double half) const;
  };

  static Capsule capsule(const Frame& pose, double length, double radius);
  static Box box(const Frame& pose, const Vec3& half);

  std::optional<Capsule> around_;  ///< the shape itself, or holds a cylinder
  std::optional<Capsule> inside_;  ///< of a cylinder
  std::optional<Box> box_;         ///< the shape itself, or holds a cylinder
};

}  // namespace sculpt
