#include "core/picture/facets.hpp"

#include <cmath>
#include <numbers>

namespace sculpt {
namespace {

constexpr int prism_sides = 24, rings = 12;

/// Takes corners in the shape's own frame.
class Surface {
 public:
  Surface(const Frame& pose, const Colour& colour, std::vector<Facet>& facets)
      : pose_(pose), colour_(colour), facets_(facets) {}

  void triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
    facets_.push_back({{pose_ * a, pose_ * b, pose_ * c}, colour_, {}});
  }
  void square(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }

 private:
  const Frame pose_;
  const Colour colour_;
  std::vector<Facet>& facets_;
};

void add_box(const Vec3& half, Surface& surface) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const Vec3 out = side * half[axis] * Vec3::Unit(axis), u = half[(axis + 1) % 3] * Vec3::Unit((axis + 1) % 3),
                 v = half[(axis + 2) % 3] * Vec3::Unit((axis + 2) % 3);
      surface.square(out + u + v, out - u + v, out - u - v, out + u - v);
    }
}

/// A point of the circle around z at a whole number of its sides.
Vec3 on_circle(double radius, int side, double z) {
  const double angle = 2 * std::numbers::pi * side / prism_sides;
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

void add_cylinder(double radius, double length, Surface& surface) {
  const double top = length / 2;
  for (int side = 0; side < prism_sides; ++side) {
    const Vec3 a = on_circle(radius, side, top), b = on_circle(radius, side + 1, top),
               c = on_circle(radius, side + 1, -top), d = on_circle(radius, side, -top);
    surface.square(a, b, c, d);
    surface.triangle({0, 0, top}, a, b);
    surface.triangle({0, 0, -top}, c, d);
  }
}

void add_sphere(double radius, Surface& surface) {
  const auto at = [&](int ring, int side) {
    const double tilt = std::numbers::pi * ring / rings;
    return on_circle(radius * std::sin(tilt), side, radius * std::cos(tilt));
  };
  for (int ring = 0; ring < rings; ++ring)
    for (int side = 0; side < prism_sides; ++side)
      surface.square(at(ring, side), at(ring, side + 1), at(ring + 1, side + 1), at(ring + 1, side));
}

}  // namespace

void add_facets(const Shape& shape, const Frame& pose, const Colour& colour, std::vector<Facet>& facets) {
  Surface surface(pose * shape.pose, colour, facets);
  switch (shape.kind) {
    case ShapeKind::box:
      add_box(shape.sides_m / 2, surface);
      break;
    case ShapeKind::cylinder:
      add_cylinder(shape.radius_m, shape.length_m, surface);
      break;
    case ShapeKind::sphere:
      add_sphere(shape.radius_m, surface);
      break;
    case ShapeKind::mesh:
      for (const auto& [a, b, c] : shape.mesh->triangles)
        surface.triangle(shape.mesh->vertices[a], shape.mesh->vertices[b], shape.mesh->vertices[c]);
      break;
  }
}

}  // namespace sculpt
