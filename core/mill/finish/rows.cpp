#include "core/mill/finish/rows.hpp"

#include <algorithm>
#include <array>
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

/// A ball that no row serves yet (tool frame).
struct Rest {
  Vec3 middle, normal;  ///< of the ball; of the surface below
  int heading;          ///< up and down the slope there
  bool is_served = false;
  bool is_wall() const { return normal.z() < wall_sine; }
};

/// Where a ball rests by a row (m).
struct Member {
  double along, height;  ///< of its middle
  std::size_t rest;
};

/// From one member of a row to another, in plan (m).
struct Span {
  double from = 0, to = 0;
  double gain = 0;  ///< so long would a row be that serves as many and none twice, without an end
  std::vector<Member> members;
};

/// Lays rows with one heading after the other.
class RowLayer {
 public:
  RowLayer(const RowTask& task, std::vector<Rest> rests) : task_(task), rests_(std::move(rests)) {}

  template <typename IsMeant>
  std::ptrdiff_t count(const IsMeant& is_meant) const {
    return std::ranges::count_if(rests_, is_meant);
  }

  /// Rows with a heading by those rests that are meant; those that a row is worth it for are served then.
  template <typename IsMeant>
  void lay(const Heading& heading, const IsMeant& is_meant) {
    std::map<std::int64_t, std::vector<Member>> lines;  // by their numbers, counted in the finest spacing
    for (std::size_t at = 0; at < rests_.size(); ++at) {
      const Rest& rest = rests_[at];
      if (!is_meant(rest)) continue;
      // The row nearest to it is enough.
      const std::int64_t stride = stride_of(heading.level(rest.normal));
      const double row = rest.middle.head<2>().dot(heading.across) / (step_m() * static_cast<double>(stride));
      lines[std::llround(row) * stride].push_back({rest.middle.head<2>().dot(heading.way), rest.middle.z(), at});
    }
    for (auto& [number, members] : lines) {
      const Point2 begin = static_cast<double>(number) * step_m() * heading.across;
      for (const Span& span : join(members)) {
        if (span.gain < task_.least_worth * (span.to - span.from + ends_m())) continue;
        rows_.push_back(row_of(span, begin, heading.way));
        for (const Member& member : span.members) rests_[member.rest].is_served = true;
      }
    }
    std::erase_if(rests_, [](const Rest& rest) { return rest.is_served; });
  }

  std::vector<Row> take() { return std::move(rows_); }

 private:
  double step_m() const { return task_.spacing_m / (1 << (finest + task_.finer)); }
  static std::int64_t stride_of(double level) {
    return std::int64_t{1} << (finest -
                               std::clamp(static_cast<int>(std::ceil(-std::log2(generous * level))), 0, finest));
  }
  double beyond_m() const { return ends_share * std::sqrt(task_.area_m2); }
  /// What a row costs besides the way between its first and last member.
  double ends_m() const { return 2 * beyond_m() + way_over_spacings * task_.spacing_m; }

  /// Over gaps that cost no more than the way to another row.
  std::vector<Span> join(std::vector<Member>& members) const {
    std::ranges::sort(members, {}, [](const Member& each) { return std::tie(each.along, each.height); });
    std::vector<Span> spans;
    for (const Member& member : members) {
      if (spans.empty() || member.along > spans.back().to + ends_m()) spans.push_back({member.along, 0, 0, {}});
      Span& span = spans.back();
      const Rest& rest = rests_[member.rest];
      span.to = member.along;
      // By walls rows always go.
      span.gain += rest.is_wall() ? ends_m() : rest.normal.z() * task_.area_m2 / task_.spacing_m;
      span.members.push_back(member);
    }
    return spans;
  }

  Row row_of(const Span& span, const Point2& begin, const Point2& way) const {
    const double low = span.from - beyond_m();
    Row row{begin + low * way, begin + (span.to + beyond_m()) * way, {}};
    for (const Member& member : span.members)
      if (rests_[member.rest].is_wall()) row.stops.push_back({member.along - low, member.height - task_.radius_m});
    return row;
  }

  RowTask task_;
  std::vector<Rest> rests_;
  std::vector<Row> rows_;
};

}  // namespace

std::vector<Row> find_rows(const RowTask& task, const ToolFrame& frame, const Nails& nails,
                           const std::vector<RestingBall>& balls) {
  std::vector<Rest> rests;
  rests.reserve(balls.size());
  for (const auto& [nail, middle] : balls)
    rests.push_back({middle, frame.of(nails[nail].normal),
                     heading_of(frame.of(mean_normal(nails, nail, look_spacings * task.spacing_m)))});
  RowLayer layer(task, std::move(rests));
  // First where one heading is good for most, so that rows are long and side by side; then each up and down its slope.
  std::array<bool, headings> is_laid{};
  for (int turn = 0; turn < headings; ++turn) {
    int best = 0;
    std::ptrdiff_t most = -1;
    const auto is_level = [](const Heading& heading) {
      return [&heading](const Rest& rest) { return generous * heading.level(rest.normal) >= 1; };
    };
    for (int number = 0; number < headings; ++number) {
      if (is_laid[static_cast<std::size_t>(number)]) continue;
      const Heading heading(number);
      if (const auto served = layer.count(is_level(heading)); served > most) most = served, best = number;
    }
    is_laid[static_cast<std::size_t>(best)] = true;
    const Heading heading(best);
    layer.lay(heading, is_level(heading));
  }
  for (int number = 0; number < headings; ++number)
    layer.lay(Heading(number), [number](const Rest& rest) { return rest.heading == number; });
  return layer.take();
}

}  // namespace sculpt
