// Facets that belong together, and which of them are turned the other way than the others of their group.
#pragma once

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace sculpt {

/// Union-find in which each facet also knows whether it is turned against the root of its group.
class FacetGroups {
 public:
  struct Place {
    std::uint32_t root;
    bool turned;
  };

  explicit FacetGroups(std::size_t facets) : above_(facets), turned_(facets, 0), size_(facets, 1) {
    std::iota(above_.begin(), above_.end(), 0u);
  }

  Place find(std::uint32_t facet) {
    std::uint32_t root = facet;
    bool turned = false;
    for (; above_[root] != root; root = above_[root]) turned ^= turned_[root] != 0;
    bool rest = turned;
    for (std::uint32_t at = facet; at != root;) {  // so that the next way is one step
      const std::uint32_t next = std::exchange(above_[at], root);
      const bool step = turned_[at] != 0;
      turned_[at] = rest;
      rest ^= step;
      at = next;
    }
    return {root, turned};
  }

  /// `against`: the two are turned against each other. False where what is known already says otherwise.
  bool join(std::uint32_t a, std::uint32_t b, bool against) {
    Place x = find(a), y = find(b);
    if (x.root == y.root) return (x.turned != y.turned) == against;
    if (size_[x.root] < size_[y.root]) std::swap(x, y);
    above_[y.root] = x.root;
    turned_[y.root] = (x.turned != y.turned) != against;
    size_[x.root] += size_[y.root];
    return true;
  }

 private:
  std::vector<std::uint32_t> above_;
  std::vector<std::uint8_t> turned_;
  std::vector<std::uint32_t> size_;
};

}  // namespace sculpt
