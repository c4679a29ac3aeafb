#include "core/mill/finish/rows/wall_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <tuple>

namespace sculpt {
namespace {

constexpr int headings = 4;
/// How far around a nail its slope is looked at, in row spacings.
constexpr double look_spacings = 3;
/// Rows at most so many times halved: 2^-3 of the spacing.
constexpr int finest = 3;
/// By so much rows may be too far apart before they are halved.
constexpr double generous = 1.15;
/// What it takes to go over from one row to the next, in spacings.
constexpr double way_over_spacings = 3;
/// Rows go on beyond their ends by so much of how far balls are from each other.
constexpr double ends_share = 0.75;
/// What leans less from the axis is a wall. Sine.
constexpr double wall_sine = 0.1;

/// In plan.
struct Heading {
  Point2 way, across;

  explicit Heading(int number) {
    const double angle = std::numbers::pi * number / headings;
    way = {std::cos(angle), std::sin(angle)};
    across = {-way.y(), way.x()};
  }
  /// Cosine of the slope of a surface across rows.
  double level(const Vec3& normal) const {
    const double up = std::max(normal.z(), 1e-3);
    return up / std::hypot(up, normal.head<2>().dot(across));
  }
};

int heading_of(const Vec3& normal) {
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

/// Where a ball rests by a row (m).
struct Member {
  double along, height;  ///< of its middle
  bool is_wall;
};

/// From one member of a row to another, in plan (m).
struct Span {
  double from = 0, to = 0;
  std::vector<Member> members;
};

/// Rows with one heading.
class Rows {
 public:
  Rows(const RowTask& task, int heading) : task_(task), heading_(heading) {}

  void add(const Vec3& middle, const Vec3& normal) {
    // The row nearest to it is enough.
    const std::int64_t stride = stride_of(heading_.level(normal));
    const double row = middle.head<2>().dot(heading_.across) / (step_m() * static_cast<double>(stride));
    lines_[std::llround(row) * stride].push_back(
        {middle.head<2>().dot(heading_.way), middle.z(), normal.z() < wall_sine});
  }

  void take(std::vector<Row>& rows) {
    for (auto& [number, members] : lines_)
      for (const Span& span : join(members))
        rows.push_back(row_of(span, static_cast<double>(number) * step_m() * heading_.across));
  }

 private:
  double step_m() const { return task_.spacing_m / (1 << (finest + task_.finer)); }
  static std::int64_t stride_of(double level) {
    return std::int64_t{1} << (finest -
                               std::clamp(static_cast<int>(std::ceil(-std::log2(generous * level))), 0, finest));
  }
  double beyond_m() const { return ends_share * std::sqrt(task_.area_m2); }

  /// Over gaps that cost no more than the way to another row.
  std::vector<Span> join(std::vector<Member>& members) const {
    std::ranges::sort(members, {}, [](const Member& each) { return std::tie(each.along, each.height); });
    const double widest_m = 2 * beyond_m() + way_over_spacings * task_.spacing_m;
    std::vector<Span> spans;
    for (const Member& member : members) {
      if (spans.empty() || member.along > spans.back().to + widest_m) spans.push_back({member.along, 0, {}});
      spans.back().to = member.along;
      spans.back().members.push_back(member);
    }
    return spans;
  }

  Row row_of(const Span& span, const Point2& begin) const {
    const double low = span.from - beyond_m();
    Row row{begin + low * heading_.way, begin + (span.to + beyond_m()) * heading_.way, {}};
    for (const Member& member : span.members)
      if (member.is_wall) row.stops.push_back({member.along - low, member.height - task_.radius_m});
    return row;
  }

  const RowTask& task_;
  Heading heading_;
  std::map<std::int64_t, std::vector<Member>> lines_;  ///< by their numbers, counted in the finest spacing
};

}  // namespace

std::vector<Row> wall_rows(const RowTask& task, const ToolFrame& frame, const Nails& nails,
                           const std::vector<RestingBall>& balls) {
  std::vector<Rows> by_heading;
  by_heading.reserve(headings);
  for (int number = 0; number < headings; ++number) by_heading.emplace_back(task, number);
  for (const RestingBall& ball : balls) {
    const Vec3 slope = frame.of(mean_normal(nails, ball.nail, look_spacings * task.spacing_m));
    by_heading[static_cast<std::size_t>(heading_of(slope))].add(ball.middle, frame.of(nails[ball.nail].normal));
  }
  std::vector<Row> rows;
  for (Rows& each : by_heading) each.take(rows);
  return rows;
}

}  // namespace sculpt
