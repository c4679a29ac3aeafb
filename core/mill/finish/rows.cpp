#include "core/mill/finish/rows.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

namespace sculpt {
namespace {

constexpr int headings = 4;
/// Surfaces that lean less than this have rows along the first heading.
constexpr double level_cosine = 0.9;
/// How far around a nail its slope is looked at, in row spacings.
constexpr double look_spacings = 3;
/// Rows at most so many times halved: 2^-3 of the spacing.
constexpr int finest = 3;
/// By so much rows may be too far apart before they are halved.
constexpr double generous = 1.15;
/// Rows go on over gaps of so many spacings.
constexpr double bridged_spacings = 8;
/// What leans less from the axis is a wall. Sine.
constexpr double wall_sine = 0.1;

struct Place {
  int heading;
  std::int64_t number;  ///< of the row, in the finest spacing
  bool operator<(const Place& other) const { return std::tie(heading, number) < std::tie(other.heading, other.number); }
};

/// Of a row, what a nail needs (m).
struct Need {
  double along, height;  ///< of the ball's middle
  bool is_wall;
};

Point2 way_of(int heading) {
  const double angle = std::numbers::pi * heading / headings;
  return {std::cos(angle), std::sin(angle)};
}

int heading_of(const Vec3& normal) {
  if (normal.z() > level_cosine) return 0;
  const double angle = std::atan2(normal.y(), normal.x()) * headings / std::numbers::pi;
  return ((static_cast<int>(std::lround(angle)) % headings) + headings) % headings;
}

Vec3 mean_normal(const Nails& nails, std::uint32_t number, double reach_m) {
  const Nail& nail = nails[number];
  Vec3 sum = nail.normal;
  nails.for_each_near(nail.point, reach_m, [&](std::uint32_t other) {
    if (nails[other].normal.dot(nail.normal) > 0) sum += nails[other].normal;
  });
  return sum.normalized();
}

}  // namespace

std::vector<Row> find_rows(const RowTask& task, const ToolFrame& frame, const Nails& nails,
                           const std::vector<RestingBall>& balls) {
  std::map<Place, std::vector<Need>> needs;
  const double around = std::sqrt(nails.area_m2()), step = task.spacing_m / (1 << (finest + task.finer));
  for (const auto& [number, middle] : balls) {
    const Vec3 normal = frame.of(nails[number].normal);
    const int heading = heading_of(frame.of(mean_normal(nails, number, look_spacings * task.spacing_m)));
    const Point2 way = way_of(heading), across(-way.y(), way.x());
    const double x = middle.head<2>().dot(way), y = middle.head<2>().dot(across);
    const double up = std::max(normal.z(), 1e-3), level = up / std::hypot(up, normal.head<2>().dot(across));
    const int halved = std::clamp(static_cast<int>(std::ceil(-std::log2(generous * level))), 0, finest);
    const std::int64_t stride = std::int64_t{1} << (finest - halved);
    const double rows = y / (step * static_cast<double>(stride));
    // The row nearest to a nail is enough for it.
    needs[{heading, std::llround(rows) * stride}].push_back({x, middle.z(), normal.z() < wall_sine});
  }
  std::vector<Row> rows;
  for (auto& [place, of_row] : needs) {
    std::ranges::sort(of_row, {}, [](const Need& need) { return std::tie(need.along, need.height); });
    const Point2 way = way_of(place.heading), across(-way.y(), way.x());
    const Point2 begin = static_cast<double>(place.number) * step * across;
    for (std::size_t at = 0; at < of_row.size();) {
      const double low = of_row[at].along - around, bridged = 2 * around + bridged_spacings * task.spacing_m;
      Row row;
      double last = 0;
      for (bool is_first = true; at < of_row.size() && (is_first || of_row[at].along <= last + bridged); ++at) {
        is_first = false;
        last = of_row[at].along;
        if (of_row[at].is_wall) row.stops.push_back({last - low, of_row[at].height - task.radius_m});
      }
      row.from = begin + low * way;
      row.to = begin + (last + around) * way;
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace sculpt
