// The air that the translating robot can be in, voxel by voxel, and ways through it.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/material/voxel.hpp"

namespace sculpt {

/// The grid with one voxel of air around it at the sides and above; nothing below the floor. Starts with that shell
/// open and the grid closed.
class OpenSpace {
 public:
  explicit OpenSpace(int n);

  bool is_open(Voxel v) const { return inside(v) && (cells_[index(v)] & open_bit) != 0; }
  void open(Voxel v) { cells_[index(v)] |= open_bit; }
  void open_cube(Voxel corner, int size);

  /// Marks the voxels of a cube as worth going to; those that are open by then count no longer.
  void want_cube(Voxel corner, int size);

  static constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();
  /// Corners of a shortest way from `from` to `to` (both open), without `from`: straight legs, one axis each where some
  /// order of the three axes is free, else by A* over at most `limit` voxels. Empty if from == to; nothing if the limit
  /// was too low.
  std::optional<std::vector<Voxel>> find_way(Voxel from, Voxel to, std::size_t limit = no_limit);

  struct Wanted {
    Voxel voxel;             ///< wanted and not open
    std::vector<Voxel> way;  ///< corners of a shortest way to a face neighbour of it
  };
  /// The wanted voxel with the shortest way from `from` (open). There must be one.
  Wanted find_wanted(Voxel from);

 private:
  static constexpr std::uint8_t open_bit = 1, wanted_bit = 2, closed_bit = 4;  // closed: the search knows the way to it
  static constexpr int parent_shift = 3;  // the face through which the search came, 3 bits

  static constexpr std::size_t most_touched = 1 << 20;  // from there on it is cheaper to clear all cells

  struct Entry {
    Voxel at;
    std::uint8_t face;
  };

  bool inside(Voxel v) const { return v.i >= -1 && v.j >= -1 && v.k >= 0 && v.i <= n_ && v.j <= n_ && v.k <= n_; }
  std::size_t index(Voxel v) const {
    const auto edge = static_cast<std::size_t>(n_) + 2;
    return static_cast<std::size_t>(v.i + 1) +
           edge * (static_cast<std::size_t>(v.j + 1) + edge * static_cast<std::size_t>(v.k));
  }
  bool leg_is_open(Voxel from, Voxel to) const;
  bool try_legs(Voxel from, Voxel to, std::vector<Voxel>& way) const;
  bool search(Voxel from, Voxel to, std::size_t limit);
  bool close(Entry entry);
  void push(Entry entry, std::size_t detour);
  void forget_search();
  std::vector<Voxel> trace(Voxel from, Voxel to) const;

  int n_;
  std::vector<std::uint8_t> cells_;
  std::vector<std::vector<Entry>>
      frontier_;  ///< by half the detour over the straight distance: bucket 0 is popped first, last in first out
  std::vector<std::size_t> touched_;  ///< closed by the running search; at `most_touched` it is no longer complete
};

}  // namespace sculpt
