#include "core/mill/rough/row_entries.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {

double length_of(const LevelWay& way) {
  double length = 0;
  for (std::size_t at = 0; at + 1 < way.size(); ++at) length += (way[at + 1] - way[at]).norm();
  return length;
}

std::vector<LevelWay> ways_into(const LevelRow& row, double radius_m, double width_m) {
  const Point2 begin = row.points.front(), out = row.field->outwards(begin),
               ahead = (row.points[1] - begin).normalized();
  std::vector<LevelWay> ways{{begin}};
  for (int halves = 1; halves <= 6; ++halves) ways.push_back({begin + halves * width_m / 2 * out, begin});
  for (const double radii : {1.0, 1.25, 1.5, 2.0})
    for (const int halves : {0, 1, 2, 3})
      ways.push_back({begin - radii * radius_m * ahead + halves * width_m / 2 * out, begin});
  for (const double radii : {3.0, 6.0}) {
    if (!row.is_closed) break;
    LevelWay way{begin};
    double back = 0;
    for (std::size_t at = row.points.size() - 1; at > 0 && back < radii * radius_m; --at) {
      back += (row.points[at] - row.points[at - 1]).norm();
      const Point2& p = row.points[at - 1];
      way.push_back(p + std::min(1.0, back / (radii * radius_m)) * width_m * row.field->outwards(p));
    }
    std::ranges::reverse(way);
    ways.push_back(std::move(way));
  }
  return ways;
}

}  // namespace sculpt
