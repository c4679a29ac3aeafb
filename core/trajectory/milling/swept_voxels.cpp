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

constexpr std::array none{infinity, -infinity}, all{-infinity, infinity};

std::array<double, 2> both(std::array<double, 2> a, std::array<double, 2> b) {
  return {std::max(a[0], b[0]), std::min(a[1], b[1])};
}

void widen(std::array<double, 2>& range, std::array<double, 2> other) {
  if (other[0] > other[1]) return;
  range = {std::min(range[0], other[0]), std::max(range[1], other[1])};
}

Vec3 to_vector(const QuantaPoint& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
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

SweptCutter::Range SweptCutter::LinearTerm::between(double low, double high, double a) const {
  if (std::abs(by_x) < 1e-9) return a >= low && a <= high ? all : none;
  const double first = (low - a) * inverse, second = (high - a) * inverse;
  return {std::min(first, second), std::max(first, second)};
}

SweptCutter::Range SweptCutter::SquareTerm::below(double a, double b) const {
  if (c < 1e-12) return LinearTerm(b).between(-infinity, 0, a);
  const double root = b * b - 4 * a * c;
  if (root < 0) return none;
  const double half = std::sqrt(root);
  return {(-b - half) * half_inverse, (-b + half) * half_inverse};
}

SweptCutter::Sweep::Sweep(const SweptCutter& cutter, const QuantaPoint& from, const QuantaPoint& to)
    : cutter_(cutter),
      base_(from),
      way_(minus(to, from)),
      way_length2_(dot(way_, way_)),
      way_rise_(dot(way_, cutter.direction_)),
      go_(to_vector(way_)),
      axis_(to_vector(cutter.direction_) / std::sqrt(static_cast<double>(cutter.direction_length2_))),
      inverse_length2_(1 / static_cast<double>(way_length2_)),
      along_go_(go_.x()),
      along_axis_(axis_.x()),
      about_go_(std::max(0.0, 1 - go_.x() * go_.x() * inverse_length2_)),
      about_axis_(std::max(0.0, 1 - axis_.x() * axis_.x())),
      across_(go_ - go_.dot(axis_) * axis_),
      beside_(axis_.cross(across_).normalized()),
      across2_(across_.squaredNorm()),
      along_across_(across_.x()),
      along_beside_(beside_.x()) {
  for (std::size_t axis = 0; axis < 3; ++axis) base_[axis] += cutter.to_base_[axis];
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

/// Of a row, about the range of x from the base on that the part sweeps; never less. `y`, `z`: of the row, from the
/// base.
SweptCutter::Range SweptCutter::Sweep::about(std::size_t part, double y, double z) const {
  return part == cutter_.cylinders_.size() ? about_ball(y, z) : about_cylinder(cutter_.cylinders_[part], y, z);
}

SweptCutter::Range SweptCutter::Sweep::about_ball(double y, double z) const {
  const double radius = static_cast<double>(cutter_.ball_radius_) + spare, radius2 = radius * radius;
  const double to_y = y - go_.y(), to_z = z - go_.z(), off2 = y * y + z * z;
  Range range = none;
  if (const double left2 = radius2 - off2; left2 >= 0) widen(range, {-std::sqrt(left2), std::sqrt(left2)});
  if (const double left2 = radius2 - to_y * to_y - to_z * to_z; left2 >= 0)
    widen(range, {go_.x() - std::sqrt(left2), go_.x() + std::sqrt(left2)});
  if (way_length2_ > 0) {
    const double along = y * go_.y() + z * go_.z();
    const Range beside =
        about_go_.below(off2 - along * along * inverse_length2_ - radius2, -2 * along * go_.x() * inverse_length2_);
    if (beside[0] <= beside[1])
      widen(range, both(beside, along_go_.between(0, static_cast<double>(way_length2_), along)));
  }
  return range[0] <= range[1] ? both(range, within_heights(-infinity, y, z)) : none;
}

SweptCutter::Range SweptCutter::Sweep::about_cylinder(const Cylinder& cylinder, double y, double z) const {
  const double radius = static_cast<double>(cylinder.radius) + spare;
  Range range = none;
  // Where the way begins, and where it ends.
  const auto widen_by = [&](double x, double dy, double dz) {
    const double up = x * axis_.x() + dy * axis_.y() + dz * axis_.z();
    widen(range, about_axis_.below(x * x + dy * dy + dz * dz - up * up - radius * radius, 2 * (x - up * axis_.x())));
  };
  widen_by(0, y, z);
  widen_by(-go_.x(), y - go_.y(), z - go_.z());
  if (across2_ > 0.25)
    widen(range, both(along_beside_.between(-radius, radius, y * beside_.y() + z * beside_.z()),
                      along_across_.between(0, across2_, y * across_.y() + z * across_.z())));
  const double low = static_cast<double>(cylinder.low) / std::sqrt(static_cast<double>(cutter_.direction_length2_));
  return range[0] <= range[1] ? both(range, within_heights(low, y, z)) : none;
}

/// At both ends of the way.
SweptCutter::Range SweptCutter::Sweep::within_heights(double low, double y, double z) const {
  const double high = cutter_.top_ + spare, at_start = y * axis_.y() + z * axis_.z();
  return both(along_axis_.between(low - spare, high, at_start),
              along_axis_.between(low - spare, high, at_start - go_.dot(axis_)));
}

std::array<int, 2> SweptCutter::Sweep::row(std::size_t part, const VoxelCentres& centres, int j, int k) const {
  const std::int64_t y = centres.at(1, j), z = centres.at(2, k);
  const auto [low, high] = about(part, static_cast<double>(y - base_[1]), static_cast<double>(z - base_[2]));
  if (!(low <= high)) return {0, -1};
  const double x0 = static_cast<double>(base_[0]);
  auto [first, last] = centres.between(0, x0 + low - spare, x0 + high + spare);
  while (first <= last && !contains(part, {centres.at(0, first), y, z})) ++first;
  while (first <= last && !contains(part, {centres.at(0, last), y, z})) --last;
  return {first, last};
}

}  // namespace sculpt
