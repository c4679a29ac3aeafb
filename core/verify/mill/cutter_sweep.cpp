#include "core/verify/mill/cutter_sweep.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace sculpt {
namespace {

__extension__ typedef __int128 Int128;

std::int64_t product(const Quanta3& a, const Quanta3& b) {
  std::int64_t sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) sum += a[axis] * b[axis];
  return sum;
}

/// Squared distance of `p` from the segment from 0 to `way`, at most radius: all products given.
bool near_segment(Int128 p_p, Int128 p_way, Int128 way_way, Int128 radius2) {
  if (p_way <= 0) return p_p <= radius2;
  if (p_way >= way_way) return p_p - 2 * p_way + way_way <= radius2;
  return p_p * way_way - p_way * p_way <= radius2 * way_way;
}

/// Calls `visit` with the number of each bit that is set, from `begin` to `end`.
template <typename Words, typename Visit>
void for_each_bit(const Words& words, std::int64_t begin, std::int64_t end, const Visit& visit) {
  for (std::int64_t word = begin >> 6; word <= end >> 6; ++word) {
    std::uint64_t bits = words[static_cast<std::size_t>(word)];
    if (word == begin >> 6) bits &= ~std::uint64_t{0} << (begin & 63);
    if (word == end >> 6) bits &= ~std::uint64_t{0} >> (63 - (end & 63));
    for (; bits != 0; bits &= bits - 1) visit(64 * word + std::countr_zero(bits));
  }
}

}  // namespace

CutterSweep::CutterSweep(const Cutter& cutter, const std::array<int, 3>& direction, double less_m)
    : direction_{direction[0], direction[1], direction[2]}, base_{}, length2_(product(direction_, direction_)) {
  const double length = std::sqrt(static_cast<double>(length2_)), corner = cutter.corner_radius_m;
  for (std::size_t axis = 0; axis < 3; ++axis)
    base_[axis] = std::llround(corner * quanta_per_metre * static_cast<double>(direction_[axis]) / length);
  const auto shrunk = [&](double radius) {
    return static_cast<std::int64_t>(std::floor((radius - less_m) * quanta_per_metre)) - 1;
  };
  const auto scaled = [&](double height) { return std::llround(height * quanta_per_metre * length); };
  const double top = cutter.flute_m - corner - less_m;
  top_ = scaled(top);
  height_ = std::llround(std::max(0.0, top) * quanta_per_metre);
  const auto add_rod = [&](double radius, double bottom) {
    if (shrunk(radius) > 0 && bottom < top) rods_.push_back({shrunk(radius), scaled(bottom)});
  };
  if (cutter.kind == CutterKind::ball) {
    ball_ = std::max<std::int64_t>(0, shrunk(cutter.radius_m));
    add_rod(cutter.radius_m, 0);
  } else {
    add_rod(cutter.radius_m, less_m);
    for (int ring = 0; ring < 4 && corner > 0; ++ring)
      add_rod(cutter.radius_m - corner + corner * ring / 4, less_m - corner * std::sqrt(1 - ring * ring / 16.0));
  }
  reach_ = ball_;
  for (const Rod& rod : rods_) reach_ = std::max(reach_, rod.radius);
}

bool CutterSweep::holds(const Quanta3& p, const Quanta3& way) const {
  const Int128 up = product(p, direction_), rise = product(way, direction_), up_at_end = up - rise;
  if (up > top_ || up_at_end > top_) return false;
  const Int128 p_p = product(p, p), p_way = product(p, way), way_way = product(way, way);
  if (ball_ > 0 && near_segment(p_p, p_way, way_way, static_cast<Int128>(ball_) * ball_)) return true;
  // Across the axis, all squares times that of its length.
  const Int128 s = length2_, a = s * p_p - up * up, b = s * p_way - up * rise, c = s * way_way - rise * rise;
  return std::ranges::any_of(rods_, [&](const Rod& rod) {
    return up >= rod.bottom && up_at_end >= rod.bottom && near_segment(a, b, c, s * rod.radius * rod.radius);
  });
}

std::uint64_t CutterSweep::take(VoxelSet& set, const Grid& grid, const Quanta3& from, const Quanta3& to,
                                std::vector<Voxel>* taken) const {
  Quanta3 start{}, way{};
  Vec3 up;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    start[axis] = from[axis] + base_[axis];
    way[axis] = to[axis] - from[axis];
    up[static_cast<int>(axis)] =
        static_cast<double>(height_) * static_cast<double>(direction_[axis]) / std::sqrt(static_cast<double>(length2_));
  }
  std::uint64_t count = 0;
  auto& words = set.words();
  const NearVoxels near(grid, start, way, up, static_cast<double>(reach_) + 2);
  near.for_each_row([&](std::int64_t first, std::int64_t last, std::int64_t j, std::int64_t k) {
    const std::int64_t row = grid.n * (j + grid.n * k), begin = row + first, end = row + last;
    Quanta3 p{0, near.from_corner(1, j), near.from_corner(2, k)};
    for_each_bit(words, begin, end, [&](std::int64_t at) {
      p[0] = near.from_corner(0, at - row);
      if (!holds(p, way)) return;
      words[static_cast<std::size_t>(at >> 6)] &= ~(std::uint64_t{1} << (at & 63));
      ++count;
      if (taken != nullptr) taken->push_back({static_cast<int>(at - row), static_cast<int>(j), static_cast<int>(k)});
    });
  });
  return count;
}

}  // namespace sculpt
