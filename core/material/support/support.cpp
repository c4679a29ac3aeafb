#include "core/material/support/support.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "core/material/support/support_search.hpp"
#include "core/material/support/support_vicinity.hpp"
#include "core/material/voxel_rows.hpp"

namespace sculpt {
namespace {

/// Height of the columns around the grid: nothing stands there that could come loose.
constexpr std::int16_t beyond = std::numeric_limits<std::int16_t>::max();

Voxel step_along(const VoxelLine& line) {
  return sign(line.last - line.first);
}

/// Of an offset in the 3 x 3 x 3 voxels about one.
constexpr std::uint32_t bit_of(Voxel offset) {
  return std::uint32_t{1} << (offset.i + 1 + 3 * (offset.j + 1) + 9 * (offset.k + 1));
}

constexpr std::uint32_t faces = bit_of({-1, 0, 0}) | bit_of({1, 0, 0}) | bit_of({0, -1, 0}) | bit_of({0, 1, 0}) |
                                bit_of({0, 0, -1}) | bit_of({0, 0, 1});

}  // namespace

/// The 3 x 3 x 3 voxels about one, which is taken as gone. Below layer 0 is the table, as if it stood
/// there.
class Support::Surroundings {
 public:
  Surroundings(const Support& support, Voxel middle) {
    const int n = support.standing_.n();
    for (int j = -1; j <= 1; ++j) {
      if (middle.j + j < 0 || middle.j + j >= n) continue;
      for (int k = -1; k <= 1 && middle.k + k < n; ++k)
        standing_ |= row(support.standing_, middle + Voxel{0, j, k}) << 3 * (j + 1 + 3 * (k + 1));
      for (int i = -1; i <= 1; ++i) {
        if (middle.i + i < 0 || middle.i + i >= n) continue;
        const bool own_column = i == 0 && j == 0;
        const int height = support.rooted(middle.i + i, middle.j + j);
        const int above = own_column ? std::min(height, middle.k) : height;
        for (int k = -1; k <= 1 && middle.k + k < above; ++k) rooted_ |= bit_of({i, j, k});
      }
    }
    standing_ &= ~bit_of({0, 0, 0});
    rooted_ &= standing_;
    for (std::uint32_t left = standing_ & faces; left != 0; left &= ~joined_to(left & (~left + 1)))
      ++parts_, any_rooted_ |= (joined_to(left & (~left + 1)) & rooted_) != 0;
  }

  /// Face neighbours that stand, in groups that are joined within the surroundings.
  int parts() const { return parts_; }
  bool any_rooted() const { return any_rooted_; }

  /// One offset of each group that nothing here joins to the table.
  std::vector<Voxel> unrooted() const {
    std::vector<Voxel> offsets;
    for (std::uint32_t left = standing_ & faces; left != 0;) {
      const int first = std::countr_zero(left);
      const std::uint32_t part = joined_to(std::uint32_t{1} << first);
      if ((part & rooted_) == 0) offsets.push_back({first % 3 - 1, first / 3 % 3 - 1, first / 9 - 1});
      left &= ~part;
    }
    return offsets;
  }

 private:
  /// Of the three voxels about `at` along x those that stand, as bits; the table does.
  static std::uint32_t row(const VoxelSet& standing, Voxel at) {
    const int n = standing.n();
    const std::uint32_t in_grid = (at.i > 0 ? 1u : 0u) | 2u | (at.i + 1 < n ? 4u : 0u);
    if (at.k < 0) return in_grid;
    const std::size_t first = standing.index(at), bit = first & 63;
    const std::uint64_t* word = standing.words().data() + (first >> 6);
    const std::uint64_t three = bit == 0    ? *word << 1 | (at.i > 0 ? word[-1] >> 63 : 0)
                                : bit == 63 ? *word >> 62 | (at.i + 1 < n ? word[1] << 2 : 0)
                                            : *word >> (bit - 1);
    return static_cast<std::uint32_t>(three) & in_grid;
  }
  std::uint32_t joined_to(std::uint32_t seeds) const {
    constexpr std::uint32_t every_third = 0x1249249, low_i = every_third, high_i = every_third << 2;
    constexpr std::uint32_t low_j = 0x1C0E07, high_j = low_j << 6;
    for (;;) {
      const std::uint32_t grown = seeds | (((seeds & ~high_i) << 1 | (seeds & ~low_i) >> 1 | (seeds & ~high_j) << 3 |
                                            (seeds & ~low_j) >> 3 | seeds << 9 | seeds >> 9) &
                                           standing_);
      if (grown == seeds) return grown;
      seeds = grown;
    }
  }

  std::uint32_t standing_ = 0, rooted_ = 0;
  int parts_ = 0;
  bool any_rooted_ = false;
};

Support::Support(const VoxelSet& standing, const VoxelSet& may_fall)
    : standing_(standing),
      loose_(find_loose(standing)),
      may_fall_(may_fall),
      rooted_(static_cast<std::size_t>(standing.n() + 2) * static_cast<std::size_t>(standing.n() + 2), beyond),
      unrooted_(static_cast<std::int64_t>(standing.size())) {
  const VoxelRows rows(standing.n());
  for (int j = 0; j < rows.n; ++j)
    for (int chunk = 0; chunk < rows.chunks; ++chunk) {
      std::uint64_t whole = rows.mask();  // columns without a gap so far
      for (int k = 0; k <= rows.n && whole != 0; ++k) {
        const std::uint64_t still = k < rows.n ? whole & rows.get(standing, j, k, chunk) : 0;
        for (std::uint64_t ended = whole & ~still; ended != 0; ended &= ended - 1)
          rooted(rows.width * chunk + std::countr_zero(ended), j) = static_cast<std::int16_t>(k);
        unrooted_ -= std::popcount(still);
        whole = still;
      }
    }
}

/// Does each neighbour that stands stand on the table in its own column, or beside a column that is as high and stands
/// on the table? The voxel's own column does not count from the voxel up.
bool Support::is_among_columns(std::size_t column, std::size_t voxel, int k) const {
  const int n = standing_.n();
  const auto stands = [&](std::size_t at) { return (standing_.words()[at >> 6] >> (at & 63) & 1) != 0; };
  const std::int16_t* height = rooted_.data() + column;
  const std::ptrdiff_t row = n + 2, sides[] = {-1, 1, -row, row};
  const auto column_beside = [&](std::ptrdiff_t at, int level) {
    return std::any_of(std::begin(sides), std::end(sides), [&](std::ptrdiff_t side) {
      return at + side != 0 && height[at + side] > level && height[at + side] != beyond;
    });
  };
  const std::ptrdiff_t step = n, voxels[] = {-1, 1, -step, step};
  for (std::size_t side = 0; side < 4; ++side)
    if (height[sides[side]] <= k && stands(voxel + static_cast<std::size_t>(voxels[side])) &&
        !column_beside(sides[side], k))
      return false;
  const auto layer = static_cast<std::size_t>(step * step);
  if (height[0] < k && stands(voxel - layer) && !column_beside(0, k - 1)) return false;
  return k + 1 == n || !stands(voxel + layer) || column_beside(0, k + 1);
}

bool Support::frees(Voxel voxel) const {
  return !is_among_columns(column(voxel.i, voxel.j), standing_.index(voxel), voxel.k) && frees_if_apart(voxel);
}

bool Support::frees_if_apart(Voxel voxel) const {
  const Surroundings around(*this, voxel);
  // What is joined stays as supported as the voxel was: through itself, or through one of them.
  if (around.parts() < 2 || loose_.contains(voxel)) return false;
  std::vector<Voxel> left = around.unrooted();
  if (left.empty()) return false;
  for (Voxel& neighbour : left) neighbour = neighbour + voxel;
  bool any_held = around.any_rooted();
  const std::function<int(int, int)> height = [this](int i, int j) { return rooted(i, j); };
  if (standing_.n() >= 8) any_held |= SupportVicinity(standing_, height, voxel).settle(left);
  if (left.empty() || (left.size() == 1 && !any_held)) return false;
  thread_local SupportSearch::Scratch scratch;
  SupportSearch search(standing_, may_fall_, height, voxel, scratch);
  using Way = SupportSearch::Way;
  while (!left.empty()) {
    const Voxel from = left.back();
    left.pop_back();
    const Way way = search.follow(from, left, any_held);
    if (way == Way::none) return true;
    if (way == Way::long_) return frees_by_flood(voxel);
    any_held |= way == Way::held;
  }
  return false;
}

bool Support::frees_by_flood(Voxel voxel) const {
  VoxelSet after = standing_;
  after.erase(voxel);
  const VoxelSet loose = find_loose(after);
  for (std::size_t word = 0; word < loose.words().size(); ++word)
    if ((loose.words()[word] & ~loose_.words()[word] & ~may_fall_.words()[word]) != 0) return true;
  return false;
}

void Support::remove(Voxel voxel) {
  remove(column(voxel.i, voxel.j), standing_.index(voxel), voxel.k);
}

void Support::remove(std::size_t column, std::size_t voxel, int k) {
  standing_.words()[voxel >> 6] &= ~(std::uint64_t{1} << (voxel & 63));
  std::int16_t& height = rooted_[column];
  unrooted_ += height > k ? height - k - 1 : -1;
  height = std::min(height, static_cast<std::int16_t>(k));
}

int Support::remove(const VoxelLine& line) {
  const Voxel step = step_along(line);
  const int count = l1(line.first, line.last) + 1, n = standing_.n();
  const auto column_step = static_cast<std::size_t>(step.i + (n + 2) * static_cast<std::ptrdiff_t>(step.j)),
             voxel_step = static_cast<std::size_t>(step.i + n * (step.j + n * static_cast<std::ptrdiff_t>(step.k)));
  std::size_t at_column = column(line.first.i, line.first.j), voxel = standing_.index(line.first);
  int k = line.first.k;
  for (int at = 0; at < count; ++at, k += step.k) {
    const bool top_of_columns_only = unrooted_ == 0 && rooted_[at_column] == k + 1;
    if (!top_of_columns_only && !is_among_columns(at_column, voxel, k) && frees_if_apart(line.first + step * at))
      return at;
    remove(at_column, voxel, k);
    at_column += column_step;  // steps back wrap around
    voxel += voxel_step;
  }
  return count;
}

void Support::restore(Voxel voxel) {
  standing_.insert(voxel);
  std::int16_t& height = rooted(voxel.i, voxel.j);
  ++unrooted_;
  if (height != voxel.k) return;
  while (height < standing_.n() && standing_.contains({voxel.i, voxel.j, height})) ++height, --unrooted_;
}

void Support::restore(const VoxelLine& line) {
  const Voxel step = step_along(line);
  for (int at = l1(line.first, line.last); at >= 0; --at) restore(line.first + step * at);
}

}  // namespace sculpt
