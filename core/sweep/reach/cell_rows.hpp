// The cells of a view as bits of whole words, for the stages that work on 64 of them at a time.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/large_pages.hpp"
#include "core/material/voxel_set.hpp"
#include "core/sweep/reach/tool_view.hpp"

namespace sculpt {

/// Row (b, c) is `chunks()` words: cell a is bit a % 64 of word a / 64, and bits beyond the last cell are 0. Reads from
/// several threads are safe, writes are not.
class CellRows {
 public:
  /// Empty, of `layers` times `rows` rows of `cells` cells.
  CellRows(int cells, int rows, int layers)
      : chunks_((cells + 63) / 64), rows_(rows), words_(static_cast<std::size_t>(chunks_) * rows * layers) {}
  /// The voxels as the view sees them.
  CellRows(const ToolView& view, const VoxelSet& voxels);

  int chunks() const { return chunks_; }
  std::uint64_t* row(int b, int c) { return words_.data() + offset(b, c); }
  const std::uint64_t* row(int b, int c) const { return words_.data() + offset(b, c); }

 private:
  std::size_t offset(int b, int c) const {
    return static_cast<std::size_t>(chunks_) * (static_cast<std::size_t>(c) * static_cast<std::size_t>(rows_) + b);
  }
  void copy(const ToolView& view, const VoxelSet& voxels);
  void turn(const ToolView& view, const VoxelSet& voxels);

  int chunks_, rows_;
  Words words_;
};

/// Calls `visit(chunk, mask)` for the words of a row that cells first..last lie in; the mask has their bits.
template <typename Visit>
void for_each_chunk(int first, int last, const Visit& visit) {
  constexpr std::uint64_t all = ~std::uint64_t{0};
  for (int chunk = first / 64; chunk <= last / 64; ++chunk) {
    std::uint64_t mask = all;
    if (chunk == first / 64) mask &= all << (first % 64);
    if (chunk == last / 64) mask &= all >> (63 - last % 64);
    visit(chunk, mask);
  }
}

inline void set_cells(std::uint64_t* row, int first, int last) {
  for_each_chunk(first, last, [row](int chunk, std::uint64_t mask) { row[chunk] |= mask; });
}

inline void clear_cells(std::uint64_t* row, int first, int last) {
  for_each_chunk(first, last, [row](int chunk, std::uint64_t mask) { row[chunk] &= ~mask; });
}

inline bool any_cell(const std::uint64_t* row, int first, int last) {
  bool any = false;
  for_each_chunk(first, last, [row, &any](int chunk, std::uint64_t mask) { any |= (row[chunk] & mask) != 0; });
  return any;
}

inline bool all_cells(const std::uint64_t* row, int first, int last) {
  bool all = true;
  for_each_chunk(first, last, [row, &all](int chunk, std::uint64_t mask) { all &= (~row[chunk] & mask) == 0; });
  return all;
}

}  // namespace sculpt
