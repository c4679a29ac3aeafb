#include "core/verify/material/standing_voxels.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/verify/material/convex_probe.hpp"
#include "core/verify/robot/solid_body.hpp"

namespace sculpt {
namespace {

/// Nothing as near to a voxel as this counts as clear of it.
constexpr double edge_mm = 1e-6;
/// A search begins where so many bricks are all that it has to look at.
constexpr int first_bricks = 8;

/// The bits of a brick with x (y, z) from `first` to `last`, 0 to 3.
constexpr std::uint64_t bits_along_x(int first, int last) {
  return std::uint64_t{0x1111111111111111} * ((0xfu << first) & (0xfu >> (3 - last)));
}
constexpr std::uint64_t bits_along_y(int first, int last) {
  return std::uint64_t{0x0001000100010001} * ((0xffffu << 4 * first) & (0xffffu >> 4 * (3 - last)));
}
constexpr std::uint64_t bits_along_z(int first, int last) {
  return (~std::uint64_t{0} << 16 * first) & (~std::uint64_t{0} >> 16 * (3 - last));
}

}  // namespace

StandingVoxels::StandingVoxels(const VoxelSet& standing, double voxel_mm, bool thorough)
    : n_(standing.n()), count_(0), voxel_mm_(voxel_mm), side_mm_(standing.n() * voxel_mm), thorough_(thorough) {
  for (auto side = static_cast<std::size_t>(n_); side > 1;) {
    side = (side + 3) / 4;
    levels_.push_back({side, Words(side * side * side)});
  }
  // Rows of a brick are four voxels of a row of the set, and n is a multiple of four.
  const auto n = static_cast<std::size_t>(n_);
  for (std::size_t word = 0; word < standing.words().size(); ++word)
    for (std::uint64_t bits = standing.words()[word]; bits != 0;) {
      const int row = std::countr_zero(bits) & ~3;
      const std::size_t at = 64 * word + static_cast<std::size_t>(row);
      const Voxel first{static_cast<int>(at % n), static_cast<int>(at / n % n), static_cast<int>(at / n / n)};
      const std::uint64_t four = bits >> row & 0xf;
      count_ += static_cast<std::size_t>(std::popcount(four));
      Level& finest = levels_.front();
      finest.words[finest.index(brick_of(first))] |= four << bit_of(first);
      bits &= ~(std::uint64_t{0xf} << row);
    }
  for (std::size_t level = 0; level + 1 < levels_.size(); ++level) {
    const Level& fine = levels_[level];
    Level& coarse = levels_[level + 1];
    for (std::size_t at = 0; at < fine.words.size(); ++at)
      if (fine.words[at] != 0) {
        const Voxel brick{static_cast<int>(at % fine.side), static_cast<int>(at / fine.side % fine.side),
                          static_cast<int>(at / fine.side / fine.side)};
        coarse.words[coarse.index(brick_of(brick))] |= std::uint64_t{1} << bit_of(brick);
      }
  }
}

VoxelSet StandingVoxels::voxels() const {
  VoxelSet standing(n_);
  const Level& finest = levels_.front();
  const int side = static_cast<int>(finest.side);
  for (std::size_t at = 0; at < finest.words.size(); ++at)
    for (std::uint64_t bits = finest.words[at]; bits != 0;) {
      const int brick = static_cast<int>(at), row = std::countr_zero(bits) & ~3;
      const std::size_t first = standing.index(
          {4 * (brick % side), 4 * (brick / side % side) + (row >> 2 & 3), 4 * (brick / side / side) + (row >> 4)});
      standing.words()[first >> 6] |= (bits >> row & 0xf) << (first & 63);
      bits &= ~(std::uint64_t{0xf} << row);
    }
  return standing;
}

void StandingVoxels::remove(Voxel v) {
  if (!contains(v)) return;
  --count_;
  if (tree_) changed_.push_back(v);
  Voxel at = v;
  for (Level& level : levels_) {
    std::uint64_t& word = level.words[level.index(brick_of(at))];
    word &= ~(std::uint64_t{1} << bit_of(at));
    if (word != 0) return;
    at = brick_of(at);
  }
}

void StandingVoxels::put_back(Voxel v) {
  if (contains(v)) return;
  ++count_;
  if (tree_) changed_.push_back(v);
  Voxel at = v;
  for (Level& level : levels_) {
    level.words[level.index(brick_of(at))] |= std::uint64_t{1} << bit_of(at);
    at = brick_of(at);
  }
}

StandingVoxels::Range StandingVoxels::range(const Vec3& low, const Vec3& high) const {
  Range range;
  for (int axis = 0; axis < 3; ++axis) {
    // In doubles: a joint that is far out gives numbers that no integer holds.
    const auto at = static_cast<std::size_t>(axis);
    range.first[at] = static_cast<int>(std::clamp(std::floor((low[axis] - edge_mm) / voxel_mm_), 0.0, n_ - 1.0));
    range.last[at] = static_cast<int>(std::clamp(std::floor((high[axis] + edge_mm) / voxel_mm_), 0.0, n_ - 1.0));
  }
  return range;
}

/// Asks `meets(middle, half a side, is a voxel)` of cubes in which something stands, until it says `found`; looks into
/// one only where it says `deeper`.
template <typename Meets>
bool StandingVoxels::find(const Range& range, const Meets& meets) const {
  std::size_t level = 0;
  int shift = 2;
  const auto bricks = [&] {
    int product = 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
      product *= (range.last[axis] >> shift) - (range.first[axis] >> shift) + 1;
    return product;
  };
  for (; level + 1 < levels_.size() && bricks() > first_bricks; ++level) shift += 2;
  for (int k = range.first[2] >> shift; k <= range.last[2] >> shift; ++k)
    for (int j = range.first[1] >> shift; j <= range.last[1] >> shift; ++j)
      for (int i = range.first[0] >> shift; i <= range.last[0] >> shift; ++i)
        if (find_in_brick(level, {i, j, k}, range, meets)) return true;
  return false;
}

template <typename Meets>
bool StandingVoxels::find_in_brick(std::size_t level, Voxel brick, const Range& range, const Meets& meets) const {
  const int shift = 2 * static_cast<int>(level);
  const std::array<int, 3> corner{4 * brick.i, 4 * brick.j, 4 * brick.k};
  std::array<int, 3> first, last;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    first[axis] = std::max(0, (range.first[axis] >> shift) - corner[axis]);
    last[axis] = std::min(3, (range.last[axis] >> shift) - corner[axis]);
  }
  const Level& here = levels_[level];
  std::uint64_t bits = here.words[here.index(brick)] & bits_along_x(first[0], last[0]) &
                       bits_along_y(first[1], last[1]) & bits_along_z(first[2], last[2]);
  const double side = voxel_mm_ * (1 << shift);
  for (; bits != 0; bits &= bits - 1) {
    const int bit = std::countr_zero(bits);
    const Voxel cube{corner[0] + (bit & 3), corner[1] + (bit >> 2 & 3), corner[2] + (bit >> 4)};
    const Look look = meets(side * Vec3(cube.i + 0.5, cube.j + 0.5, cube.k + 0.5), side / 2, level == 0);
    if (look == Look::found) return true;
    if (look == Look::deeper && find_in_brick(level - 1, cube, range, meets)) return true;
  }
  return false;
}

MaterialTree& StandingVoxels::tree() const {
  if (!tree_) tree_ = std::make_unique<MaterialTree>(voxels(), voxel_mm_);
  for (const Voxel v : changed_) tree_->set(v, contains(v));
  changed_.clear();
  return *tree_;
}

bool StandingVoxels::touches(const fcl::CollisionGeometryd& geometry, const Frame& pose, const Vec3& low,
                             const Vec3& high) const {
  if (count_ == 0 || (high.array() < 0).any() || (low.array() > side_mm_).any()) return false;
  if (thorough_) return tree().touches(geometry, pose);
  const Range box = range(low, high);
  const auto probe = ConvexProbe::of(geometry, pose);
  if (!probe)
    return find(box, [](const Vec3&, double, bool is_voxel) { return is_voxel ? Look::found : Look::deeper; }) &&
           tree().touches(geometry, pose);
  return find(box, [&](const Vec3& centre, double half, bool is_voxel) {
    const Meeting meeting = probe->with_cube(centre, half);
    if (meeting == Meeting::apart) return Look::nothing;
    if (!is_voxel) return Look::deeper;
    if (meeting == Meeting::meet) return Look::found;
    const fcl::Boxd voxel(Vec3::Constant(2 * half));
    return solids_touch(voxel, Frame(Eigen::Translation3d(centre)), geometry, pose) ? Look::found : Look::nothing;
  });
}

}  // namespace sculpt
