// Triangles -> pixels: a z-buffer seen along one direction, without perspective.
#pragma once

#include <cstdint>
#include <vector>

#include "core/picture/facets.hpp"

namespace sculpt {

/// Rows from the top, three bytes a pixel.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// Where one looks from and how much is seen.
struct View {
  Vec3 right, up;                ///< unit vectors, at right angles; one looks against their cross product
  Vec3 middle_m = Vec3::Zero();  ///< in the middle of the picture
  double span_m = 1;             ///< that fits into its shorter side
  double edge_m = 0;             ///< a jump of depth that shows as an edge; at least about a hundredth of the span
};

/// Draws with twice the pixels each way and gives the mean of four. Not shared between threads.
class Canvas {
 public:
  Canvas(int width, int height, const View& view);

  void draw(const Facet& facet);
  /// A line of some pixels' width; drawn over what stands up to `lift_m` nearer.
  void draw_line(const Vec3& from_m, const Vec3& to_m, const Colour& colour, double lift_m);

  /// Darkens where the depth jumps, so that edges show, and gives the picture.
  Picture finish() const;

 private:
  struct Point {
    double x, y, depth;  ///< pixels; depth grows towards the eye (m)
  };
  Point project(const Vec3& at_m) const;
  double light_on(const Facet& facet) const;  ///< 0 to 1
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  void set(int x, int y, double depth, const Colour& colour);
  bool is_edge(int x, int y) const;

  int width_, height_;
  View view_;
  Vec3 towards_eye_;
  double pixels_per_m_;
  std::vector<Colour> colours_;
  std::vector<double> depths_;
};

}  // namespace sculpt
