#include "core/mesh/polygon.hpp"

#include <charconv>
#include <limits>

namespace sculpt {
namespace {

constexpr std::size_t max_corners_looked_at = 64;

/// Twice the area, along the normal.
Vec3 area_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b - a).cross(c - a);
}

bool is_seen_whole(std::span<const std::uint32_t> corners, std::size_t from, const Vec3& normal, const Mesh& mesh) {
  const auto at = [&](std::size_t c) { return mesh.vertices[corners[(from + c) % corners.size()]]; };
  for (std::size_t c = 1; c + 1 < corners.size(); ++c)
    if (area_of(at(0), at(c), at(c + 1)).dot(normal) < 0) return false;
  return true;
}

std::size_t find_apex(std::span<const std::uint32_t> corners, const Mesh& mesh) {
  if (corners.size() == 3 || corners.size() > max_corners_looked_at) return 0;
  Vec3 normal = Vec3::Zero();
  for (std::size_t c = 1; c + 1 < corners.size(); ++c)
    normal += area_of(mesh.vertices[corners[0]], mesh.vertices[corners[c]], mesh.vertices[corners[c + 1]]);
  for (std::size_t from = 0; from < corners.size(); ++from)
    if (is_seen_whole(corners, from, normal, mesh)) return from;
  return 0;
}

}  // namespace

void add_polygon(std::span<const std::uint32_t> corners, Mesh& mesh) {
  if (corners.size() < 3) return;
  const std::size_t apex = find_apex(corners, mesh);
  const auto at = [&](std::size_t c) { return corners[(apex + c) % corners.size()]; };
  for (std::size_t c = 1; c + 1 < corners.size(); ++c) mesh.triangles.push_back({at(0), at(c), at(c + 1)});
}

std::optional<double> parse_coordinate(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || word.empty()) return std::nullopt;
  if (error == std::errc::result_out_of_range)  // or too small to be anything but zero
    return word.find("e-") == std::string_view::npos && word.find("E-") == std::string_view::npos
               ? std::numeric_limits<double>::infinity()
               : 0;
  return error == std::errc{} ? std::optional(value) : std::nullopt;
}

}  // namespace sculpt
