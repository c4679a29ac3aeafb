#include "core/trajectory/milling/swept_voxels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/trajectory/quantum.hpp"

namespace sculpt {
namespace {

__extension__ typedef __int128 Wide;  // of GCC and Clang

constexpr double infinity = std::numeric_limits<double>::infinity();
/// By so much rows are looked at in wider bounds than doubles give: their errors are far below a quantum.
constexpr double spare = 2;
constexpr int rim_cylinders = 3;

std::int64_t to_whole(double value) {
  return std::llround(value);
}

std::int64_t dot(const QuantaPoint& a, const QuantaPoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

QuantaPoint minus(const QuantaPoint& a, const QuantaPoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Wide wide(std::int64_t value) {
  return value;
}

/// Where a + b x + c x^2 <= 0 (c >= 0).
std::array<double, 2> solve(double a, double b, double c) {
  if (c < 1e-12) {
    if (std::abs(b) < 1e-9) return a <= 0 ? std::array{-infinity, infinity} : std::array{infinity, -infinity};
    return b > 0 ? std::array{-infinity, -a / b} : std::array{-a / b, infinity};
  }
  const double root = b * b - 4 * a * c;
  if (root < 0) return {infinity, -infinity};
  const double half = std::sqrt(root);
  return {(-b - half) / (2 * c), (-b + half) / (2 * c)};
}

/// Where low <= a + b x <= high.
std::array<double, 2> solve_between(double low, double high, double a, double b) {
  if (std::abs(b) < 1e-9)
    return a >= low && a <= high ? std::array{-infinity, infinity} : std::array{infinity, -infinity};
  const double first = (low - a) / b, second = (high - a) / b;
  return {std::min(first, second), std::max(first, second)};
}

std::array<double, 2> both(std::array<double, 2> a, std::array<double, 2> b) {
  return {std::max(a[0], b[0]), std::min(a[1], b[1])};
}

void widen(std::array<double, 2>& range, std::array<double, 2> other) {
  if (other[0] > other[1]) return;
  range = {std::min(range[0], other[0]), std::max(range[1], other[1])};
}

}  // namespace

VoxelCentres::VoxelCentres(const Grid& grid) : n_(grid.n) {
  const std::int64_t size = to_whole(grid.n * grid.voxel_m * quanta_per_unit), n = grid.n;
  step_ = static_cast<double>(size) / static_cast<double>(n);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t origin = to_whole(grid.origin_m[static_cast<int>(axis)] * quanta_per_unit);
    origin_[axis] = static_cast<double>(origin);
    for (std::int64_t i = 0; i < n; ++i) centres_[axis].push_back(origin + ((2 * i + 1) * size + n) / (2 * n));
  }
}

std::array<int, 2> VoxelCentres::between(std::size_t axis, double low, double high) const {
  // Two more on both sides than doubles say, then exactly.
  const auto near = [&](double value, int more) {
    return static_cast<int>(std::clamp((value - origin_[axis]) / step_ + more, -1.0, n_ + 0.0));
  };
  int first = std::clamp(near(low, -2), 0, n_ - 1), last = std::clamp(near(high, 2), 0, n_ - 1);
  while (first <= last && static_cast<double>(at(axis, first)) < low) ++first;
  while (first <= last && static_cast<double>(at(axis, last)) > high) --last;
  return {first, last};
}

SweptCutter::SweptCutter(const Cutter& cutter, const std::array<int, 3>& direction, double less_m)
    : direction_{direction[0], direction[1], direction[2]}, direction_length2_(dot(direction_, direction_)) {
  const double length = std::sqrt(static_cast<double>(direction_length2_));
  const auto quanta = [](double metres) { return metres * quanta_per_unit; };
  // One quantum less for the rounding of the base.
  const auto smaller = [&](double metres) {
    return static_cast<std::int64_t>(std::floor(quanta(metres - less_m))) - 1;
  };
  const double base_m = cutter.corner_radius_m;
  for (std::size_t axis = 0; axis < 3; ++axis)
    to_base_[axis] = to_whole(quanta(base_m) * static_cast<double>(direction_[axis]) / length);
  const auto height = [&](double metres) { return to_whole(quanta(metres) * length); };
  const double high_m = cutter.flute_m - base_m - less_m;
  high_ = height(high_m);
  const auto add = [&](double radius_m, double low_m) {
    const std::int64_t radius = smaller(radius_m);
    if (radius <= 0 || low_m + less_m >= high_m) return;
    cylinders_.push_back({radius, height(low_m + less_m)});
    reach_ = std::max(reach_, radius);
  };
  if (cutter.kind == CutterKind::ball) {
    ball_radius_ = std::max<std::int64_t>(0, smaller(cutter.radius_m));
    reach_ = ball_radius_;
    add(cutter.radius_m, -less_m);  // the ball is smaller all around: the cylinder begins at its centre
  } else {
    add(cutter.radius_m, 0);
    const double inner_m = cutter.radius_m - cutter.corner_radius_m;
    for (int step = 0; step <= rim_cylinders && cutter.corner_radius_m > 0; ++step) {
      const double share = static_cast<double>(step) / (rim_cylinders + 1);
      add(inner_m + cutter.corner_radius_m * share, -cutter.corner_radius_m * std::sqrt(1 - share * share));
    }
  }
  top_ = std::max(0.0, quanta(high_m));
  reach_ = std::max<std::int64_t>(reach_, 0);
}

bool SweptCutter::sweeps(const QuantaPoint& from, const QuantaPoint& to, const QuantaPoint& point) const {
  const Sweep sweep(*this, from, to);
  for (std::size_t part = 0; part < parts(); ++part)
    if (sweep.contains(part, point)) return true;
  return false;
}

bool SweptCutter::any_in_row(const VoxelSet& set, int first, int last, int j, int k) {
  const std::size_t low = set.index({first, j, k}), high = set.index({last, j, k});
  const std::size_t low_word = low >> 6, high_word = high >> 6;
  const std::uint64_t from = ~std::uint64_t{0} << (low & 63), to = ~std::uint64_t{0} >> (63 - (high & 63));
  if (low_word == high_word) return (set.words()[low_word] & from & to) != 0;
  if ((set.words()[low_word] & from) != 0 || (set.words()[high_word] & to) != 0) return true;
  for (std::size_t word = low_word + 1; word < high_word; ++word)
    if (set.words()[word] != 0) return true;
  return false;
}

SweptCutter::Sweep::Sweep(const SweptCutter& cutter, const QuantaPoint& from, const QuantaPoint& to)
    : cutter_(cutter), base_(from), way_(minus(to, from)) {
  for (std::size_t axis = 0; axis < 3; ++axis) base_[axis] += cutter.to_base_[axis];
  way_length2_ = dot(way_, way_);
  way_rise_ = dot(way_, cutter.direction_);
}

SweptCutter::Box SweptCutter::Sweep::box(const VoxelCentres& centres) const {
  Box box{};
  const double length = std::sqrt(static_cast<double>(cutter_.direction_length2_));
  const double below = static_cast<double>(cutter_.reach_);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double up = cutter_.top_ * static_cast<double>(cutter_.direction_[axis]) / length;
    const double a = static_cast<double>(base_[axis]), b = static_cast<double>(base_[axis] + way_[axis]);
    // A rim is no lower below its base than the reach; neither is a ball.
    const auto [first, last] = centres.between(axis, std::min({a, b, a + up, b + up}) - below - spare,
                                               std::max({a, b, a + up, b + up}) + below + spare);
    box.first[axis] = first;
    box.last[axis] = last;
  }
  return box;
}

bool SweptCutter::Sweep::contains(std::size_t part, const QuantaPoint& point) const {
  const QuantaPoint v = minus(point, base_), w = minus(v, way_);
  const std::int64_t at_start = dot(v, cutter_.direction_), at_end = at_start - way_rise_;
  if (std::max(at_start, at_end) > cutter_.high_) return false;
  if (part == cutter_.cylinders_.size()) {
    const std::int64_t radius2 = cutter_.ball_radius_ * cutter_.ball_radius_, along = dot(v, way_);
    if (along <= 0) return dot(v, v) <= radius2;
    if (along >= way_length2_) return dot(w, w) <= radius2;
    return wide(dot(v, v)) * way_length2_ - wide(along) * along <= wide(radius2) * way_length2_;
  }
  const Cylinder& cylinder = cutter_.cylinders_[part];
  if (std::min(at_start, at_end) < cylinder.low) return false;
  // Lengths across the axis, times that of the direction: |v x a|^2 = s |v|^2 - (v a)^2.
  const Wide s = cutter_.direction_length2_, bound = s * cylinder.radius * cylinder.radius;
  const Wide along = s * dot(v, way_) - wide(at_start) * way_rise_;
  const Wide length2 = s * way_length2_ - wide(way_rise_) * way_rise_;
  const Wide from_start = s * dot(v, v) - wide(at_start) * at_start;
  if (along <= 0) return from_start <= bound;
  if (along >= length2) return s * dot(w, w) - wide(at_end) * at_end <= bound;
  return from_start * length2 - along * along <= bound * length2;
}

/// Of a row, about the range of x (from x0 on) that the part sweeps; never less.
std::array<double, 2> SweptCutter::Sweep::about(std::size_t part, double x0, double y, double z) const {
  const Vec3 way(static_cast<double>(way_[0]), static_cast<double>(way_[1]), static_cast<double>(way_[2]));
  const Vec3 v(x0, y, z), w = v - way;  // at x = 0 of the row
  const auto within_ball = [](const Vec3& at, double radius) {
    return solve(at.squaredNorm() - radius * radius, 2 * at.x(), 1);
  };
  const double length = std::sqrt(static_cast<double>(cutter_.direction_length2_));
  const Vec3 axis = Vec3(static_cast<double>(cutter_.direction_[0]), static_cast<double>(cutter_.direction_[1]),
                         static_cast<double>(cutter_.direction_[2])) /
                    length;
  const auto above_both = [&](double low) {
    std::array<double, 2> above{-infinity, infinity};
    for (const Vec3& at : {v, w})
      above = both(above, solve_between(low - spare, static_cast<double>(cutter_.high_) / length + spare, at.dot(axis),
                                        axis.x()));
    return above;
  };
  std::array<double, 2> range{infinity, -infinity};
  if (part == cutter_.cylinders_.size()) {
    const double radius = static_cast<double>(cutter_.ball_radius_) + spare;
    widen(range, within_ball(v, radius));
    widen(range, within_ball(w, radius));
    if (const auto length2 = static_cast<double>(way_length2_); length2 > 0) {
      const double along = v.dot(way), x = way.x();
      const auto beside = solve(v.squaredNorm() - along * along / length2 - radius * radius,
                                2 * (v.x() - along * x / length2), std::max(0.0, 1 - x * x / length2));
      widen(range, both(beside, solve_between(0, length2, along, x)));
    }
    return both(range, above_both(-infinity));
  }
  const Cylinder& cylinder = cutter_.cylinders_[part];
  const double radius = static_cast<double>(cylinder.radius) + spare;
  const auto within_cylinder = [&](const Vec3& at) {
    const double up = at.dot(axis);
    return solve(at.squaredNorm() - up * up - radius * radius, 2 * (at.x() - up * axis.x()),
                 std::max(0.0, 1 - axis.x() * axis.x()));
  };
  widen(range, within_cylinder(v));
  widen(range, within_cylinder(w));
  const Vec3 across = way - way.dot(axis) * axis;
  if (const double across2 = across.squaredNorm(); across2 > 0.25) {
    const Vec3 beside = axis.cross(across) / std::sqrt(across2);
    widen(range, both(solve_between(-radius, radius, v.dot(beside), beside.x()),
                      solve_between(0, across2, v.dot(across), across.x())));
  }
  return both(range, above_both(static_cast<double>(cylinder.low) / length));
}

std::array<int, 2> SweptCutter::Sweep::row(std::size_t part, const VoxelCentres& centres, int j, int k) const {
  const std::int64_t y = centres.at(1, j), z = centres.at(2, k);
  const auto [low, high] = about(part, 0, static_cast<double>(y - base_[1]), static_cast<double>(z - base_[2]));
  if (!(low <= high)) return {0, -1};
  const double x0 = static_cast<double>(base_[0]);
  auto [first, last] = centres.between(0, x0 + low - spare, x0 + high + spare);
  while (first <= last && !contains(part, {centres.at(0, first), y, z})) ++first;
  while (first <= last && !contains(part, {centres.at(0, last), y, z})) --last;
  return {first, last};
}

}  // namespace sculpt
