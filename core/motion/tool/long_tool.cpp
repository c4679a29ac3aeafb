#include "core/motion/tool/long_tool.hpp"

#include <utility>

#include "core/material/voxel_rows.hpp"

namespace sculpt {
namespace {

class Peel {
 public:
  Peel(Voxel lean, const VoxelSet& wanted, VoxelSet& standing)
      : rows_(standing.n()), lean_(lean), wanted_(wanted), standing_(standing) {
    const auto n = static_cast<std::size_t>(rows_.n);
    for (auto* layer : {&dark_, &dark_above_}) layer->resize(n * static_cast<std::size_t>(rows_.chunks));
  }

  bool run() {
    for (int k = rows_.n - 1; k >= 0; --k) {
      for (int row = rows_.n - 1; row >= 0; --row) peel_row(lean_.j < 0 ? rows_.n - 1 - row : row, k);
      if (lean_.k != 0) std::swap(dark_, dark_above_);
    }
    return taken_;
  }

 private:
  using Word = std::uint64_t;

  bool in_row(int j, int chunk) const { return j >= 0 && j < rows_.n && chunk >= 0 && chunk < rows_.chunks; }
  Word stands(int j, int k, int chunk) const {
    return in_row(j, chunk) && k < rows_.n ? rows_.get(standing_, j, k, chunk) : 0;
  }
  Word& dark(int j, int chunk) { return dark_[static_cast<std::size_t>(j * rows_.chunks + chunk)]; }

  /// What the voxels with the next i along the axis have: `word`, and `beyond` in the next chunk that way.
  Word next_of(Word word, Word beyond) const {
    return (lean_.i > 0 ? word >> 1 | beyond << (rows_.width - 1) : word << 1 | beyond >> (rows_.width - 1)) &
           rows_.mask();
  }

  /// What stands at most one row away along the axis, without the row itself.
  Word straight(int j, int k, int chunk) const {
    Word bits = 0;
    if (lean_.j != 0) bits |= stands(j + lean_.j, k, chunk);
    if (lean_.k != 0) bits |= stands(j, k + lean_.k, chunk);
    if (lean_.j != 0 && lean_.k != 0) bits |= stands(j + lean_.j, k + lean_.k, chunk);
    return bits;
  }

  /// Where the row that the axis leads to next is in the shadow, or stands beside it.
  Word across(int j, int k, int chunk) const {
    const int next = j + lean_.j;
    const auto& layer = lean_.k != 0 ? dark_above_ : dark_;
    const Word shade =
        in_row(next, chunk) && k + lean_.k < rows_.n ? layer[static_cast<std::size_t>(next * rows_.chunks + chunk)] : 0;
    return lean_.i == 0 ? shade : shade | straight(j, k, chunk);
  }

  void peel_row(int j, int k) {
    const bool in_line = lean_.j == 0 && lean_.k == 0;
    const int out = lean_.i > 0 ? 1 : -1;
    Word beyond_open = rows_.mask();  // of the chunk before: what is open there, to this row's end and to others
    Word beyond_stands = 0;
    for (int at = 0; at < rows_.chunks; ++at) {
      const int chunk = lean_.i > 0 ? rows_.chunks - 1 - at : at;
      const Word before = rows_.get(standing_, j, k, chunk), wanted = before & rows_.get(wanted_, j, k, chunk);
      Word shade = 0;
      if (!in_line) {
        shade = across(j, k, chunk);
        if (lean_.i != 0) shade = next_of(shade, across(j, k, chunk + out));
        shade |= straight(j, k, chunk);
      }
      const Word air = ~before & rows_.mask();
      Word gone = wanted & ~shade;
      if (lean_.i != 0) {
        // Within the row each voxel waits for the next one; in line with the axis for all up to the row's end.
        const Word through = in_line ? air | wanted : gone, open = in_line ? 0 : air;
        const Word reached = fill(through, through & next_of(open, beyond_open));
        gone = reached & wanted;
        beyond_open = reached | open;
      }
      const Word after = before & ~gone;
      if (lean_.i != 0) shade |= next_of(after, beyond_stands);
      beyond_stands = after;
      if (!in_line) dark(j, chunk) = shade;
      if (gone == 0) continue;
      rows_.put(standing_, j, k, chunk, after);
      taken_ = true;
    }
  }

  /// From `reached` against the axis as far as `through` goes.
  Word fill(Word through, Word reached) const {
    for (int step = 1; step < rows_.width; step *= 2) {
      reached |= through & (lean_.i > 0 ? reached >> step : reached << step);
      through &= lean_.i > 0 ? through >> step : through << step;
    }
    return reached & rows_.mask();
  }

  VoxelRows rows_;
  Voxel lean_;
  const VoxelSet& wanted_;
  VoxelSet& standing_;
  std::vector<Word> dark_, dark_above_;  ///< of the layer at work and of the one above it, row by row
  bool taken_ = false;
};

}  // namespace

bool peel_along(Voxel lean, const VoxelSet& wanted, VoxelSet& standing) {
  return Peel(lean, wanted, standing).run();
}

}  // namespace sculpt
