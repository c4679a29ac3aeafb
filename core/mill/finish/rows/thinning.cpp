#include "core/mill/finish/rows/thinning.hpp"

#include <algorithm>
#include <iterator>

namespace sculpt {
namespace {

/// Above, then around to the right.
using Around = std::array<bool, 8>;

Around around(const std::vector<char>& marked, const Lattice& lattice, std::size_t cell) {
  const auto w = static_cast<std::size_t>(lattice.width);
  const auto is = [&](std::size_t at) { return marked[at] != 0; };
  return {is(cell + w), is(cell + w + 1), is(cell + 1), is(cell - w + 1),
          is(cell - w), is(cell - w - 1), is(cell - 1), is(cell + w - 1)};
}

/// Pieces of what is marked around a cell.
int pieces(const Around& ring) {
  int count = 0;
  for (std::size_t at = 0; at < 8; at += 2) count += !ring[at] && (ring[at + 1] || ring[(at + 2) % 8]);
  return count;
}

/// Marked ones around a cell, two neighbours counted as one where that makes fewer.
int pairs(const Around& ring) {
  int first = 0, second = 0;
  for (std::size_t at = 0; at < 8; at += 2) {
    first += ring[(at + 7) % 8] || ring[at];
    second += ring[at] || ring[at + 1];
  }
  return std::min(first, second);
}

/// At the border of what is marked, at its lower right or its upper left, and no end and no link.
bool may_go(const Around& ring, bool upper_left) {
  const auto [above, above_right, right, below_right, below, below_left, left, above_left] = ring;
  const bool is_kept =
      upper_left ? (below || below_left || !above_left) && left : (above || above_right || !below_right) && right;
  return !is_kept && pieces(ring) == 1 && pairs(ring) >= 2 && pairs(ring) <= 3;
}

}  // namespace

std::array<std::size_t, 8> neighbours(const Lattice& lattice, std::size_t cell) {
  const auto w = static_cast<std::size_t>(lattice.width);
  return {cell + 1, cell + w, cell - 1, cell - w, cell + w + 1, cell + w - 1, cell - w - 1, cell - w + 1};
}

int branches(const std::vector<char>& marked, const Lattice& lattice, std::size_t cell) {
  return pieces(around(marked, lattice, cell));
}

void thin(std::vector<char>& marked, const Lattice& lattice) {
  std::vector<std::size_t> left;
  for (std::size_t cell = 0; cell < marked.size(); ++cell)
    if (marked[cell] != 0) left.push_back(cell);
  const auto take_off = [&](bool upper_left) {
    std::vector<std::size_t> off;
    std::ranges::copy_if(left, std::back_inserter(off),
                         [&](std::size_t cell) { return may_go(around(marked, lattice, cell), upper_left); });
    for (const std::size_t cell : off) marked[cell] = 0;
    std::erase_if(left, [&](std::size_t cell) { return marked[cell] == 0; });
    return !off.empty();
  };
  bool goes_on = true;
  while (goes_on) {
    const bool at_upper_left = take_off(true), at_lower_right = take_off(false);
    goes_on = at_upper_left || at_lower_right;
  }
}

}  // namespace sculpt
