// Convex shapes, and planes between two of them: what a distance is proved by. Any one unit of length.
#pragma once

#include <array>
#include <vector>

#include "core/base/frame.hpp"

namespace sculpt {

/// A box, a cylinder or a triangle, and all points within `radius` of it. A box with half sides of 0 is a rectangle, a
/// segment or a point, and with a radius a capsule or a sphere.
struct Convex {
  enum class Kind { box, cylinder, triangle };

  Kind kind = Kind::box;
  double radius = 0;
  Vec3 middle = Vec3::Zero();  ///< a triangle's first corner
  /// Of a box its axes, of a cylinder too (it stands along the last one), of a triangle from the first corner to the
  /// second, to the third, and a unit normal.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  Vec3 half = Vec3::Zero();  ///< half sides; of a cylinder (radius, radius, half its length), of a triangle nothing

  static Convex sphere(const Vec3& middle, double radius);
  static Convex capsule(const Vec3& a, const Vec3& b, double radius);
  static Convex box(const Frame& pose, const Vec3& half);
  static Convex cylinder(const Frame& pose, double radius, double half_length);
  static Convex triangle(const Vec3& a, const Vec3& b, const Vec3& c);

  /// About its middle.
  Vec3 centre() const { return kind == Kind::triangle ? Vec3(middle + (axes.col(0) + axes.col(1)) / 3) : middle; }
  /// Nothing of it is farther from `centre` than this.
  double extent() const {
    return radius + (kind == Kind::triangle ? std::max(axes.col(0).norm(), axes.col(1).norm()) : half.norm());
  }
  Convex placed(const Frame& pose) const;

  /// Points and a radius: within it of their hull lies all of the shape, and but for a cylinder nothing else.
  struct Corners {
    std::array<Vec3, 24> points;
    std::size_t count = 0;
    double radius = 0;

    void add(const Vec3& point) { points[count++] = point; }
  };
  Corners corners() const;
};

/// All of the first shape lies on the side of a plane that `normal` (of length 1) points to, all of the second one on
/// the other, at least `gap` apart along it; below 0 where none was found.
struct Separation {
  Vec3 normal = Vec3::UnitX();
  double gap = 0;
  double second_to = 0;  ///< how far the second one reaches along the normal
};

/// How many planes are tried: a rough search may miss one where edges or faces of the two are close.
enum class Effort { rough, full };
inline Effort effort(bool to_decide) {
  return to_decide ? Effort::full : Effort::rough;
}

/// The best plane of those that are tried: across the way between points of the two that alternating projections
/// (Cheney, Goldstein, "Proximity maps for convex sets", 1959) find, along faces, and along pairs of edges (Gottschalk,
/// Lin, Manocha, "OBBTree", 1996). Whatever way it was found, its gap is exact. Looks no further once one has a gap of
/// `enough`.
Separation separate(const Convex& first, const Convex& second, double enough, Effort effort);

}  // namespace sculpt
