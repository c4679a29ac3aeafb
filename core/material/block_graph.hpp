// Octree -> BlockGraph: leaves joined by shared faces, at mixed sizes (neighbour finding after Samet 1989).
#pragma once

#include <span>

#include "core/material/octree.hpp"

namespace sculpt {

/// Compressed rows: the neighbours of leaf b, by rising id, are neighbours[first[b] .. first[b + 1]).
struct BlockGraph {
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> neighbours;

  std::span<const std::uint32_t> of(int block) const {
    return {neighbours.data() + first[block], neighbours.data() + first[block + 1]};
  }
};

/// Throws Cancelled.
BlockGraph build_block_graph(const Octree& octree, const Watch& watch);

}  // namespace sculpt
