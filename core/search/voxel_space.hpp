// What the translating robot finds at every voxel, and the shortest way through air to what it looks for.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "core/material/voxel_grid.hpp"

namespace sculpt {

/// The grid with one voxel of air around it at the sides and above, nothing below the floor; one byte a voxel. Voxels
/// are named by their index, so that a face neighbour is one addition away. Not shared between threads.
class VoxelSpace {
 public:
  using Index = std::uint32_t;

  explicit VoxelSpace(const VoxelGrid& voxels);

  Index index(Voxel v) const {
    const auto edge = static_cast<Index>(edge_);
    return static_cast<Index>(v.i + 2) + edge * (static_cast<Index>(v.j + 2) + edge * static_cast<Index>(v.k + 1));
  }
  Voxel voxel(Index at) const {
    const auto edge = static_cast<Index>(edge_);
    return {static_cast<int>(at % edge) - 2, static_cast<int>(at / edge % edge) - 2,
            static_cast<int>(at / edge / edge) - 1};
  }
  Index beside(Index at, int face) const { return at + steps_[face]; }

  bool is_air(Index at) const { return (cells_[at] & air_bit) != 0; }
  bool is_remove(Index at) const { return (cells_[at] & remove_bit) != 0; }
  void open(Index at) { cells_[at] = air_bit; }
  void open_cube(Voxel corner, int size);
  /// The robot can be nowhere there, as if it stood; nor go from the one to the other, either way.
  void close(Voxel position) { cells_[index(position)] = 0; }
  void block(Voxel from, Voxel to);
  bool is_blocked(Index at, int face) const { return !blocked_.empty() && blocked_.contains({at, face}); }
  /// Face neighbours that are to be removed.
  int count_remove(Index at) const {
    int count = 0;
    for (Index step : steps_) count += is_remove(at + step);
    return count;
  }

  /// At least how many steps from a voxel to where the way may end; changes by one at most from a voxel to its
  /// neighbour. `most` is an upper bound that the caller knows.
  using Distance = std::function<int(Voxel from, int most)>;

  /// The faces to go through, on a shortest way through air, from `from` to any voxel where `distance` is `enough`.
  /// Nothing if there is none. A*: `distance` is its heuristic, so it looks at little more than the way where the way
  /// is free, and at all of a pocket only where the way out of it leads away from what is near.
  std::optional<std::vector<std::uint8_t>> find_way(Index from, int enough, const Distance& distance);

 private:
  static constexpr std::uint8_t remove_bit = 1, air_bit = 2, closed_bit = 4;  // closed: the search knows the way to it
  static constexpr int parent_shift = 3;  // the face through which the search came, 3 bits
  static constexpr int known_shift = 6;   // 1 + the distance modulo 3, 2 bits

  struct Entry {
    Index at;
    int distance;
    std::uint8_t face;
  };

  static std::uint8_t cell_of(bool stock, bool keep) { return stock ? (keep ? 0 : remove_bit) : air_bit; }
  int distance_at(Index at, int most, const Distance& distance);
  void expand(const Entry& entry, std::size_t detour, const Distance& distance);
  std::vector<std::uint8_t> trace(Index from, Index to) const;
  void forget_search();

  int edge_;
  std::array<Index, 6> steps_;  ///< to the face neighbours, modulo 2^32
  std::vector<std::uint8_t> cells_;
  std::set<std::pair<Index, int>> blocked_;
  std::vector<std::vector<Entry>> frontier_;  ///< by detour over the first distance; last in first out, so it goes deep
  std::vector<Index> touched_;                ///< looked at by the running search
};

}  // namespace sculpt
