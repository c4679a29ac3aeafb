#include "core/search/voxel_space.hpp"

#include <algorithm>

#include "core/material/voxel_rows.hpp"

namespace sculpt {

VoxelSpace::VoxelSpace(const VoxelGrid& voxels)
    : edge_(voxels.n() + 4), cells_(static_cast<std::size_t>(edge_) * edge_ * (edge_ - 1)) {
  for (std::size_t face = 0; face < 6; ++face) steps_[face] = index(face_steps[face]) - index({0, 0, 0});
  const int n = voxels.n();
  const VoxelRows rows(n);
  for (int k = 0; k <= n; ++k) {
    for (int j = -1; j <= n; ++j) {
      std::uint8_t* row = cells_.data() + index({0, j, k});
      std::fill(row - 1, row + n + 1, air_bit);
      if (j < 0 || j == n || k == n) continue;
      for (int chunk = 0; chunk < rows.chunks; ++chunk) {
        const std::uint64_t stock = rows.get(voxels.stock, j, k, chunk), keep = rows.get(voxels.keep, j, k, chunk);
        if (stock == 0) continue;
        for (int bit = 0; bit < rows.width; ++bit)
          row[chunk * rows.width + bit] = cell_of((stock >> bit & 1) != 0, (keep >> bit & 1) != 0);
      }
    }
  }
}

void VoxelSpace::open_cube(Voxel corner, int size) {
  for (int k = 0; k < size; ++k)
    for (int j = 0; j < size; ++j) std::fill_n(cells_.data() + index(corner + Voxel{0, j, k}), size, air_bit);
}

void VoxelSpace::block(Voxel from, Voxel to) {
  for (int face = 0; face < 6; ++face) {
    if (from + face_steps[face] != to) continue;
    blocked_.insert({index(from), face});
    blocked_.insert({index(to), face ^ 1});
  }
}

/// A voxel is come by from several sides. What was said of it is kept modulo 3: it is `most`, or one or two less.
int VoxelSpace::distance_at(Index at, int most, const Distance& distance) {
  if (const int known = cells_[at] >> known_shift) return most - (most - (known - 1) + 3) % 3;
  const int there = distance(voxel(at), most);
  cells_[at] |= static_cast<std::uint8_t>((1 + there % 3) << known_shift);
  touched_.push_back(at);
  return there;
}

void VoxelSpace::expand(const Entry& entry, std::size_t detour, const Distance& distance) {
  // Straight on is pushed last and so tried first: the fewer turns the better.
  for (int turn = 1; turn <= 6; ++turn) {
    const auto face = static_cast<std::uint8_t>((entry.face + turn) % 6);
    const Index next = beside(entry.at, face);
    if ((cells_[next] & (air_bit | closed_bit)) != air_bit || is_blocked(entry.at, face)) continue;
    const int there = distance_at(next, entry.distance + 1, distance);
    const std::size_t further = detour + static_cast<std::size_t>(1 + there - entry.distance);
    if (frontier_.size() <= further) frontier_.resize(further + 1);
    frontier_[further].push_back({next, there, face});
  }
}

std::optional<std::vector<std::uint8_t>> VoxelSpace::find_way(Index from, int enough, const Distance& distance) {
  std::optional<std::vector<std::uint8_t>> way;
  frontier_.resize(std::max<std::size_t>(frontier_.size(), 1));
  frontier_[0].push_back({from, distance_at(from, 3 * edge_, distance), 0});
  for (std::size_t detour = 0; detour < frontier_.size() && !way; ++detour) {
    while (!frontier_[detour].empty() && !way) {
      const Entry entry = frontier_[detour].back();
      frontier_[detour].pop_back();
      if (cells_[entry.at] & closed_bit) continue;
      cells_[entry.at] |= static_cast<std::uint8_t>(closed_bit | entry.face << parent_shift);
      if (entry.distance == enough)
        way = trace(from, entry.at);
      else
        expand(entry, detour, distance);
    }
  }
  forget_search();
  return way;
}

std::vector<std::uint8_t> VoxelSpace::trace(Index from, Index to) const {
  std::vector<std::uint8_t> way;
  for (Index at = to; at != from;) {
    way.push_back(cells_[at] >> parent_shift & 7);
    at -= steps_[way.back()];
  }
  std::reverse(way.begin(), way.end());
  return way;
}

void VoxelSpace::forget_search() {
  for (Index at : touched_) cells_[at] &= air_bit;
  touched_.clear();
  for (auto& bucket : frontier_) bucket.clear();
}

}  // namespace sculpt
