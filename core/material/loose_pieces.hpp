// Which pieces of material hang on nothing. The stock is clamped to the table from below: what a face-connected path of
// standing voxels joins to layer k = 0 is held, everything else would fall.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "core/material/voxel_grid.hpp"

namespace sculpt {

/// The standing voxels that hang on nothing.
VoxelSet find_loose(const VoxelSet& standing);

/// The parts of the finished sculpture that hang on nothing, with what they enclose: once all around them is gone
/// nothing can hold them.
VoxelSet find_unheld(const VoxelGrid& voxels);

/// Face-connected pieces of a set.
std::uint64_t count_pieces(const VoxelSet& voxels);

/// Voxels in a straight line along one axis, removed one after the other from `first` to `last`.
struct VoxelLine {
  Voxel first, last;
};

/// The removal of `removed` (of line number `line`) leaves `freed` voxels hanging on nothing that hung on something.
struct Loosening {
  std::size_t line;
  Voxel removed;
  std::uint64_t freed;
  std::uint64_t unforeseen;  ///< of them, those that were not said to fall
};

struct LoosePieces {
  std::uint64_t at_start = 0;         ///< voxels that hang on nothing before the first removal
  std::uint64_t most = 0;             ///< voxels that hang on nothing when most do, at the start and the end too
  std::vector<Loosening> loosenings;  ///< in the order of removal; empty: nothing that was held is ever freed
};

/// What falls when `lines` are removed from `stock` in this order; each voxel is in `stock` and in one line. Counts
/// what is never removed (keep, residue) and what is still to be removed, the rest of the same line included. Two
/// grids of bits, and about 10 ns a voxel.
LoosePieces find_loose_pieces(const VoxelSet& stock, const std::vector<VoxelLine>& lines);

/// The same for `lines` lines that are kept in another form: `line` gives one by its number, and is asked twice.
/// `may_fall`: voxels that are known to come loose.
LoosePieces find_loose_pieces(const VoxelSet& stock, const VoxelSet& may_fall, std::size_t lines,
                              const std::function<VoxelLine(std::size_t)>& line);

}  // namespace sculpt
