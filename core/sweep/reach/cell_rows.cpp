#include "core/sweep/reach/cell_rows.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/material/voxel_rows.hpp"

namespace sculpt {
namespace {

using Tile = std::array<std::uint64_t, 64>;

/// Bit t of word r becomes bit r of word t: squares of half the size change places, down to single bits.
void transpose(Tile& tile) {
  std::uint64_t low = ~std::uint64_t{0};
  for (std::size_t half = 32; half > 0; half /= 2) {
    low ^= low << half;  // the lower half of every 2 * half bits
    for (std::size_t pair = 0; pair < 64; pair += 2 * half)
      for (std::size_t r = pair; r < pair + half; ++r) {
        const std::uint64_t change = ((tile[r] >> half) ^ tile[r + half]) & low;
        tile[r] ^= change << half;
        tile[r + half] ^= change;
      }
  }
}

/// The first bit last: neighbours change places, then pairs, nibbles, bytes...
std::uint64_t reversed(std::uint64_t word) {
  std::uint64_t low = ~std::uint64_t{0};
  for (int half = 32; half > 0; half /= 2) {
    low ^= low << half;  // the lower half of every 2 * half bits
    word = ((word >> half) & low) | ((word & low) << half);
  }
  return word;
}

bool all_equal(const Tile& tile, std::size_t width, std::uint64_t word) {
  return std::all_of(tile.begin(), tile.begin() + static_cast<std::ptrdiff_t>(width),
                     [word](std::uint64_t other) { return other == word; });
}

}  // namespace

CellRows::CellRows(const ToolView& view, const VoxelSet& voxels) : CellRows(view.n, view.n, view.n) {
  if (view.step[0].i != 0)
    copy(view, voxels);
  else
    turn(view, voxels);
}

void CellRows::copy(const ToolView& view, const VoxelSet& voxels) {
  const VoxelRows from(view.n);
  for (int c = 0; c < view.n; ++c)
    for (int b = 0; b < view.n; ++b) {
      const Voxel first = view.voxel({0, b, c});
      std::uint64_t* to = row(b, c);
      for (int chunk = 0; chunk < chunks_; ++chunk) {
        const std::uint64_t word = from.get(voxels, first.j, first.k, chunk);
        if (view.step[0].i > 0)
          to[chunk] = word;
        else
          to[chunks_ - 1 - chunk] = reversed(word) >> (64 - from.width);
      }
    }
}

/// Tiles of 64 x 64 cells in planes of x and the view's rows.
void CellRows::turn(const ToolView& view, const VoxelSet& voxels) {
  const VoxelRows from(view.n);
  const bool x_is_b = view.step[1].i != 0;
  const int step_x = view.step[x_is_b ? 1 : 2].i;
  for (int other = 0; other < view.n; ++other)
    for (int a = 0; a < view.n; a += 64)
      for (int x = 0; x < view.n; x += 64) {
        Tile tile{};
        const Voxel corner{a, x_is_b ? 0 : other, x_is_b ? other : 0};
        for (int r = 0; r < from.width; ++r) {
          const Voxel voxel = view.voxel(corner + Voxel{r, 0, 0});
          tile[static_cast<std::size_t>(r)] = from.get(voxels, voxel.j, voxel.k, x / 64);
        }
        if (all_equal(tile, static_cast<std::size_t>(from.width), 0)) continue;
        if (from.width < 64 || !all_equal(tile, 64, ~std::uint64_t{0})) transpose(tile);
        for (int t = 0; t < from.width; ++t) {
          const int along = (x + t - view.corner.i) * step_x;
          row(x_is_b ? along : other, x_is_b ? other : along)[a / 64] = tile[static_cast<std::size_t>(t)];
        }
      }
}

}  // namespace sculpt
