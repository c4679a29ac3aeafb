// A set of voxels of an n x n x n grid, one bit each.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "core/base/large_pages.hpp"
#include "core/material/voxel.hpp"

namespace sculpt {

/// Bit i + n (j + n k) stands for voxel (i, j, k). Reads from several threads are safe, writes are not.
class VoxelSet {
 public:
  VoxelSet() = default;
  explicit VoxelSet(int n, bool full = false)
      : n_(n), words_((static_cast<std::size_t>(n) * n * n + 63) / 64, full ? ~std::uint64_t{0} : 0) {}

  int n() const { return n_; }
  std::size_t index(Voxel v) const {
    return static_cast<std::size_t>(v.i) + n_ * (v.j + static_cast<std::size_t>(n_) * v.k);
  }
  bool contains(Voxel v) const {
    const std::size_t at = index(v);
    return (words_[at >> 6] >> (at & 63)) & 1;
  }
  void insert(Voxel v) {
    const std::size_t at = index(v);
    words_[at >> 6] |= std::uint64_t{1} << (at & 63);
  }
  void erase(Voxel v) {
    const std::size_t at = index(v);
    words_[at >> 6] &= ~(std::uint64_t{1} << (at & 63));
  }
  /// A straight run along one axis, both ends included.
  void erase(Voxel first, Voxel last) {
    const std::size_t from = std::min(index(first), index(last)), to = std::max(index(first), index(last));
    const std::size_t step = first == last ? 1 : (to - from) / static_cast<std::size_t>(l1(first, last));
    for (std::size_t at = from; at <= to; at += step) words_[at >> 6] &= ~(std::uint64_t{1} << (at & 63));
  }
  std::size_t size() const {
    std::size_t sum = 0;
    for (std::uint64_t word : words_) sum += static_cast<std::size_t>(std::popcount(word));
    return sum;
  }
  /// The bits, lowest index in the lowest bit of the first word. n^3 is a multiple of 64 for every n >= 4.
  const Words& words() const { return words_; }
  Words& words() { return words_; }

  VoxelSet& operator-=(const VoxelSet& other) {
    for (std::size_t at = 0; at < words_.size(); ++at) words_[at] &= ~other.words_[at];
    return *this;
  }

  bool operator==(const VoxelSet&) const = default;

 private:
  int n_ = 0;
  Words words_;
};

/// Calls `visit` with every voxel of the set, by index.
template <typename Visit>
void for_each_voxel(const VoxelSet& set, const Visit& visit) {
  const auto n = static_cast<std::size_t>(set.n());
  for (std::size_t word = 0; word < set.words().size(); ++word)
    for (std::uint64_t bits = set.words()[word]; bits != 0; bits &= bits - 1) {
      const std::size_t at = 64 * word + static_cast<std::size_t>(std::countr_zero(bits));
      visit(Voxel{static_cast<int>(at % n), static_cast<int>(at / n % n), static_cast<int>(at / (n * n))});
    }
}

}  // namespace sculpt
