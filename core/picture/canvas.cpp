#include "core/picture/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sculpt {
namespace {

constexpr int finer = 2;
constexpr Colour paper{250, 250, 248};
constexpr double nowhere = -std::numeric_limits<double>::max();
constexpr double min_light = 0.45, line_pixels = 2.5;
constexpr double edge_of_span = 0.012;

Colour shade(const Colour& colour, double light) {
  Colour out;
  for (std::size_t c = 0; c < 3; ++c) out[c] = static_cast<std::uint8_t>(std::clamp(light * colour[c], 0.0, 255.0));
  return out;
}

}  // namespace

Canvas::Canvas(int width, int height, const View& view)
    : width_(finer * width),
      height_(finer * height),
      view_(view),
      towards_eye_(view.right.cross(view.up)),
      pixels_per_m_(std::min(width_, height_) / view.span_m),
      colours_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), paper),
      depths_(colours_.size(), nowhere) {}

Canvas::Point Canvas::project(const Vec3& at_m) const {
  const Vec3 off = at_m - view_.middle_m;
  return {width_ / 2.0 + pixels_per_m_ * off.dot(view_.right), height_ / 2.0 - pixels_per_m_ * off.dot(view_.up),
          off.dot(towards_eye_)};
}

void Canvas::set(int x, int y, double depth, const Colour& colour) {
  const std::size_t at = index(x, y);
  if (depth <= depths_[at]) return;
  depths_[at] = depth;
  colours_[at] = colour;
}

double Canvas::light_on(const Facet& facet) const {
  const Vec3 lamp = (towards_eye_ + 0.5 * view_.up - 0.35 * view_.right).normalized();
  if (facet.normal) return std::max(0.0, facet.normal->dot(lamp));
  const Vec3 normal = (facet.corners[1] - facet.corners[0]).cross(facet.corners[2] - facet.corners[0]).normalized();
  return std::abs(normal.dot(lamp));  // from both sides
}

void Canvas::draw(const Facet& facet) {
  const Point a = project(facet.corners[0]), b = project(facet.corners[1]), c = project(facet.corners[2]);
  const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  if (std::abs(area) < 1e-9) return;
  const Colour colour = shade(facet.colour, min_light + (1 - min_light) * light_on(facet));
  const int left = std::max(0, static_cast<int>(std::floor(std::min({a.x, b.x, c.x})))),
            right = std::min(width_ - 1, static_cast<int>(std::ceil(std::max({a.x, b.x, c.x})))),
            top = std::max(0, static_cast<int>(std::floor(std::min({a.y, b.y, c.y})))),
            bottom = std::min(height_ - 1, static_cast<int>(std::ceil(std::max({a.y, b.y, c.y}))));
  for (int y = top; y <= bottom; ++y)
    for (int x = left; x <= right; ++x) {
      const double px = x + 0.5, py = y + 0.5;
      const double of_b = ((px - a.x) * (c.y - a.y) - (c.x - a.x) * (py - a.y)) / area;
      const double of_c = ((b.x - a.x) * (py - a.y) - (px - a.x) * (b.y - a.y)) / area;
      if (of_b < 0 || of_c < 0 || of_b + of_c > 1) continue;
      set(x, y, a.depth + of_b * (b.depth - a.depth) + of_c * (c.depth - a.depth), colour);
    }
}

void Canvas::draw_line(const Vec3& from_m, const Vec3& to_m, const Colour& colour, double lift_m) {
  const Point a = project(from_m), b = project(to_m);
  const int steps = 1 + static_cast<int>(std::hypot(b.x - a.x, b.y - a.y) * 2);
  const int half = static_cast<int>(line_pixels);
  for (int step = 0; step <= steps; ++step) {
    const double t = static_cast<double>(step) / steps;
    const int x = static_cast<int>(a.x + t * (b.x - a.x)), y = static_cast<int>(a.y + t * (b.y - a.y));
    for (int dy = -half; dy <= half; ++dy)
      for (int dx = -half; dx <= half; ++dx)
        if (dx * dx + dy * dy <= half * half && x + dx >= 0 && y + dy >= 0 && x + dx < width_ && y + dy < height_)
          set(x + dx, y + dy, a.depth + t * (b.depth - a.depth) + lift_m, colour);
  }
}

bool Canvas::is_edge(int x, int y) const {
  const double here = depths_[index(x, y)], jump = std::max(view_.edge_m, edge_of_span * view_.span_m);
  return (x + 1 < width_ && std::abs(here - depths_[index(x + 1, y)]) > jump) ||
         (y + 1 < height_ && std::abs(here - depths_[index(x, y + 1)]) > jump);
}

Picture Canvas::finish() const {
  Picture picture{width_ / finer, height_ / finer, {}};
  picture.rgb.reserve(3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      std::array<int, 3> sum{};
      for (int part = 0; part < finer * finer; ++part) {
        const int fine_x = finer * x + part % finer, fine_y = finer * y + part / finer;
        const double light = is_edge(fine_x, fine_y) ? 0.35 : 1;
        const Colour colour = shade(colours_[index(fine_x, fine_y)], light);
        for (std::size_t c = 0; c < 3; ++c) sum[c] += colour[c];
      }
      for (const int value : sum) picture.rgb.push_back(static_cast<std::uint8_t>(value / (finer * finer)));
    }
  return picture;
}

}  // namespace sculpt
