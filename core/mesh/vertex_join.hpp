// Vertices at the same point become one vertex, numbered in the order they are first met.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "core/base/frame.hpp"
#include "core/base/random.hpp"

namespace sculpt {

/// Open-addressed hash from a point's exact coordinates to its id in `vertices`.
class VertexJoin {
 public:
  /// Memory in the worst case: the point itself in a doubling vector, an id and four slots of the table.
  static constexpr std::uint64_t bytes_a_vertex = 2 * sizeof(Vec3) + 5 * sizeof(std::uint32_t);

  /// At most `count` calls of `add` follow.
  VertexJoin(std::vector<Vec3>& vertices, std::uint64_t count)
      : vertices_(vertices), slots_(std::bit_ceil(2 * count + 1), free_slot) {}

  std::uint32_t add(Vec3 point) {
    point.array() += 0.0;  // -0 and 0 are one point
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) hash = mix(hash, std::bit_cast<std::uint64_t>(point[axis]));
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t slot = hash & mask;; slot = (slot + 1) & mask) {
      if (slots_[slot] == free_slot) {
        slots_[slot] = static_cast<std::uint32_t>(vertices_.size());
        vertices_.push_back(point);
        return slots_[slot];
      }
      if (vertices_[slots_[slot]] == point) return slots_[slot];
    }
  }

 private:
  static constexpr std::uint32_t free_slot = ~std::uint32_t{0};
  std::vector<Vec3>& vertices_;
  std::vector<std::uint32_t> slots_;
};

}  // namespace sculpt
