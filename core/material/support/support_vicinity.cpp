#include "core/material/support/support_vicinity.hpp"

#include <algorithm>

namespace sculpt {
namespace {

constexpr int edge = 8;
constexpr std::uint64_t first_column = 0x0101010101010101, last_column = first_column << 7;

/// Of the corner, so that the voxel is in the middle or the grid's side is.
int low_of(int at, int n) {
  return std::clamp(at - edge / 2, 0, n - edge);
}

}  // namespace

SupportVicinity::SupportVicinity(const VoxelSet& standing, const std::function<int(int, int)>& rooted, Voxel gone)
    : n_(standing.n()),
      corner_{low_of(gone.i, standing.n()), low_of(gone.j, standing.n()), low_of(gone.k, standing.n())} {
  std::array<int, edge * edge> heights;
  for (int j = 0; j < edge; ++j)
    for (int i = 0; i < edge; ++i) {
      const bool own = corner_.i + i == gone.i && corner_.j + j == gone.j;
      const int height = rooted(corner_.i + i, corner_.j + j);
      heights[static_cast<std::size_t>(i + edge * j)] = own ? std::min(height, gone.k) : height;
    }
  for (std::size_t k = 0; k < edge; ++k) {
    for (int j = 0; j < edge; ++j) {
      const std::size_t at = standing.index(corner_ + Voxel{0, j, static_cast<int>(k)});
      const std::size_t word = at >> 6, bit = at & 63;
      std::uint64_t row = standing.words()[word] >> bit;
      if (bit > 64 - edge) row |= standing.words()[word + 1] << (64 - bit);
      standing_[k] |= (row & 0xff) << (edge * j);
    }
    for (std::size_t at = 0; at < heights.size(); ++at)
      rooted_[k] |= std::uint64_t{heights[at] > corner_.k + static_cast<int>(k)} << at;
  }
  const Voxel in = gone - corner_;
  standing_[static_cast<std::size_t>(in.k)] &= ~(std::uint64_t{1} << (in.i + edge * in.j));
  for (std::size_t k = 0; k < edge; ++k) rooted_[k] &= standing_[k];
}

SupportVicinity::Layers SupportVicinity::joined_to(Voxel voxel) const {
  const Voxel in = voxel - corner_;
  Layers joined{};
  joined[static_cast<std::size_t>(in.k)] = std::uint64_t{1} << (in.i + edge * in.j);
  for (bool grew = true; grew;) {
    grew = false;
    const auto grow = [&](std::size_t k) {
      const std::uint64_t beside = (joined[k] & ~last_column) << 1 | (joined[k] & ~first_column) >> 1 | joined[k] << 8 |
                                   joined[k] >> 8 | (k > 0 ? joined[k - 1] : 0) | (k + 1 < edge ? joined[k + 1] : 0);
      const std::uint64_t grown = joined[k] | (beside & standing_[k]);
      grew |= grown != joined[k];
      joined[k] = grown;
    };
    for (std::size_t k = 0; k < edge; ++k) grow(k);
    for (std::size_t k = edge; k-- > 0;) grow(k);
  }
  return joined;
}

bool SupportVicinity::goes_on(const Layers& joined) const {
  constexpr std::uint64_t first_row = 0xff, last_row = first_row << 56;
  const auto sides = [](int low, int n, std::uint64_t first, std::uint64_t last) {
    return (low > 0 ? first : 0) | (low + edge < n ? last : 0);
  };
  const std::uint64_t side =
      sides(corner_.i, n_, first_column, last_column) | sides(corner_.j, n_, first_row, last_row);
  std::uint64_t any = 0;
  for (const std::uint64_t layer : joined) any |= layer & side;
  if (corner_.k > 0) any |= joined.front();
  if (corner_.k + edge < n_) any |= joined.back();
  return any != 0;
}

bool SupportVicinity::settle(std::vector<Voxel>& left) const {
  std::vector<Voxel> open, closed;
  bool any_held = false;
  while (!left.empty()) {
    const Voxel from = left.back();
    const Layers joined = joined_to(from);
    std::erase_if(left, [&](Voxel other) { return holds(joined, other - corner_); });
    bool held = false;
    for (std::size_t k = 0; k < edge; ++k) held |= (joined[k] & rooted_[k]) != 0;
    any_held |= held;
    if (!held) (goes_on(joined) ? open : closed).push_back(from);
  }
  left = std::move(open);
  left.insert(left.end(), closed.begin(), closed.end());
  return any_held;
}

}  // namespace sculpt
