#include "core/mill/finish/pencil.hpp"

#include <cstddef>
#include <limits>
#include <optional>

namespace sculpt {
namespace {

class Chains {
 public:
  Chains(const std::vector<Vec3>& middles, double link_m) : middles_(middles), link2_(link_m * link_m) {
    is_left_.assign(middles.size(), 1);
  }

  /// From a place on, to the nearest that is left, as far as it goes.
  std::size_t grow(std::size_t end, std::vector<Row>& rows) {
    is_left_[end] = 0;
    std::size_t links = 0;
    for (auto next = nearest(end); next; next = nearest(end), ++links) {
      rows.push_back({middles_[end].head<2>(), middles_[*next].head<2>()});
      end = *next;
      is_left_[end] = 0;
    }
    return links;
  }
  bool is_left(std::size_t place) const { return is_left_[place] != 0; }

 private:
  std::optional<std::size_t> nearest(std::size_t to) const {
    std::optional<std::size_t> found;
    double least2 = link2_;
    for (std::size_t at = 0; at < middles_.size(); ++at) {
      if (is_left_[at] == 0) continue;
      const double distance2 = (middles_[at] - middles_[to]).squaredNorm();
      if (distance2 < least2) least2 = distance2, found = at;
    }
    return found;
  }

  const std::vector<Vec3>& middles_;
  double link2_;
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
    rows.push_back({at, at + Point2(short_m, 0)});
  }
  return rows;
}

}  // namespace sculpt
