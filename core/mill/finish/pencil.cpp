#include "core/mill/finish/pencil.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>

namespace sculpt {
namespace {

class Chains {
 public:
  Chains(const std::vector<Vec3>& middles, double link_m)
      : middles_(middles), link_m_(link_m), order_(middles.size()), rank_(middles.size()), is_left_(middles.size(), 1) {
    std::iota(order_.begin(), order_.end(), 0);
    std::ranges::stable_sort(order_, {}, [&](std::size_t at) { return middles[at].x(); });
    for (std::size_t rank = 0; rank < order_.size(); ++rank) rank_[order_[rank]] = rank;
  }

  /// From a place on, to the nearest that is left, as far as it goes.
  std::size_t grow(std::size_t end, std::vector<Row>& rows) {
    is_left_[end] = 0;
    std::size_t links = 0;
    for (auto next = nearest(end); next; next = nearest(end), ++links) {
      rows.push_back({middles_[end].head<2>(), middles_[*next].head<2>(), {}});
      end = *next;
      is_left_[end] = 0;
    }
    return links;
  }
  bool is_left(std::size_t place) const { return is_left_[place] != 0; }

 private:
  std::optional<std::size_t> nearest(std::size_t to) const {
    std::optional<std::size_t> found;
    double least = link_m_;
    // False where none that follows in that way is nearer.
    const auto look = [&](std::size_t at) {
      if (std::abs(middles_[at].x() - middles_[to].x()) >= least) return false;
      if (is_left_[at] == 0) return true;
      if (const double distance = (middles_[at] - middles_[to]).norm(); distance < least) least = distance, found = at;
      return true;
    };
    for (std::size_t rank = rank_[to]; rank-- > 0 && look(order_[rank]);) continue;
    for (std::size_t rank = rank_[to]; ++rank < order_.size() && look(order_[rank]);) continue;
    return found;
  }

  const std::vector<Vec3>& middles_;
  double link_m_;
  std::vector<std::size_t> order_, rank_;  ///< by the first coordinate
  std::vector<char> is_left_;
};

}  // namespace

std::vector<Row> pencil_rows(const std::vector<Vec3>& middles, double link_m, double short_m) {
  std::vector<Row> rows;
  Chains chains(middles, link_m);
  for (std::size_t begin = 0; begin < middles.size(); ++begin) {
    if (!chains.is_left(begin)) continue;
    if (chains.grow(begin, rows) + chains.grow(begin, rows) > 0) continue;
    const Point2 at = middles[begin].head<2>();
    rows.push_back({at, at + Point2(short_m, 0), {}});
  }
  return rows;
}

}  // namespace sculpt
