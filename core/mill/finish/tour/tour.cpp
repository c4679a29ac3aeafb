#include "core/mill/finish/tour/tour.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

#include "core/mill/finish/tour/arcs.hpp"
#include "core/mill/finish/tour/place_boxes.hpp"

namespace sculpt {
namespace {

constexpr std::size_t neighbours_kept = 10, most_moved = 3;
constexpr int most_passes = 30;
/// Ways are not made better by less (m).
constexpr double least_gain_m = 1e-9;

/// An order of arcs, each by the end where it begins: ends 2 a and 2 a + 1 are those of arc a.
class Order {
 public:
  explicit Order(const std::vector<Contour>& arcs) {
    for (const Contour& arc : arcs) ends_.insert(ends_.end(), {arc.front(), arc.back()});
    find_neighbours();
  }

  std::vector<std::uint32_t> run() {
    take_nearest_next();
    find_places();
    for (int pass = 0; pass < most_passes; ++pass) {
      bool is_better = false;
      for (std::uint32_t arc = 0; arc < order_.size(); ++arc) is_better |= turn_after(arc) || turn_before(arc);
      for (std::size_t count = 1; count <= most_moved; ++count)
        for (std::uint32_t arc = 0; arc < order_.size(); ++arc) is_better |= move(arc, count);
      if (!is_better) break;
    }
    return std::move(order_);
  }

 private:
  static std::uint32_t other(std::uint32_t end) { return end ^ 1U; }
  double way(std::uint32_t from, std::uint32_t to) const { return (ends_[from] - ends_[to]).norm(); }
  std::uint32_t end_of(std::size_t place) const { return other(order_[place]); }
  /// From the end of the arc in a place to the next one.
  double way_after(std::size_t place) const {
    return place + 1 < order_.size() ? way(end_of(place), order_[place + 1]) : 0;
  }
  double way_before(std::size_t place) const { return place > 0 ? way_after(place - 1) : 0; }

  void find_neighbours() {
    Eigen::AlignedBox3d box;
    for (const Vec3& end : ends_) box.extend(end);
    box_edge_ = std::max(1e-6, box.sizes().maxCoeff() / std::sqrt(static_cast<double>(ends_.size())));
    const PlaceBoxes boxes(ends_, box_edge_);
    near_.resize(ends_.size());
    for (std::uint32_t end = 0; end < ends_.size(); ++end) {
      std::vector<std::pair<double, std::uint32_t>> found;
      for (std::int64_t away = 1; away <= 4 && found.size() < neighbours_kept; away *= 2) {
        found.clear();
        boxes.for_each_near(ends_[end], away, [&](std::uint32_t to) {
          if (to / 2 != end / 2) found.emplace_back(way(end, to), to);
        });
      }
      std::ranges::sort(found);
      found.resize(std::min(found.size(), neighbours_kept));
      for (const auto& [far, to] : found) near_[end].push_back(to);
    }
  }

  void take_nearest_next() {
    std::vector<char> is_left(ends_.size() / 2, 1);
    std::vector<std::uint32_t> rest(ends_.size());
    std::iota(rest.begin(), rest.end(), 0);
    std::uint32_t next = 0;
    for (double least = 0; std::isfinite(least);) {
      order_.push_back(next);
      is_left[next / 2] = 0;
      const std::uint32_t from = other(order_.back());
      least = std::numeric_limits<double>::infinity();
      const auto look = [&](std::uint32_t to) {
        if (is_left[to / 2] != 0 && way(from, to) < least) least = way(from, to), next = to;
      };
      std::ranges::for_each(near_[from], look);
      if (least < box_edge_) continue;
      std::erase_if(rest, [&](std::uint32_t end) { return is_left[end / 2] == 0; });
      std::ranges::for_each(rest, look);
    }
  }

  void find_places() {
    place_.resize(order_.size());
    set_places(0, order_.size());
  }
  void set_places(std::size_t first, std::size_t end) {
    for (std::size_t place = first; place < end; ++place) place_[order_[place] / 2] = place;
  }

  /// What is from `first` up to `end`, the other way around.
  void turn(std::size_t first, std::size_t end) {
    std::reverse(iterator(first), iterator(end));
    for (std::size_t place = first; place < end; ++place) order_[place] = other(order_[place]);
    set_places(first, end);
  }
  std::vector<std::uint32_t>::iterator iterator(std::size_t place) {
    return order_.begin() + static_cast<std::ptrdiff_t>(place);
  }

  /// From the end of an arc to that of a later one: what is behind it up to that one is turned. False where nothing is
  /// better.
  bool turn_after(std::uint32_t arc) {
    const std::size_t here = place_[arc];
    const std::uint32_t end = end_of(here);
    for (const std::uint32_t to : near_[end]) {
      if (way_after(here) - way(end, to) < least_gain_m) return false;
      const std::size_t there = place_[to / 2];
      if (there <= here || end_of(there) != to) continue;
      const double joined = there + 1 < order_.size() ? way(order_[here + 1], order_[there + 1]) : 0;
      if (way_after(here) + way_after(there) - way(end, to) - joined < least_gain_m) continue;
      turn(here + 1, there + 1);
      return true;
    }
    return false;
  }

  /// From the beginning of an earlier arc to that of this one: what is before it from that one on is turned.
  bool turn_before(std::uint32_t arc) {
    const std::size_t here = place_[arc];
    const std::uint32_t begin = order_[here];
    for (const std::uint32_t to : near_[begin]) {
      if (way_before(here) - way(begin, to) < least_gain_m) return false;
      const std::size_t there = place_[to / 2];
      if (there >= here || order_[there] != to) continue;
      const double joined = there > 0 ? way(end_of(there - 1), end_of(here - 1)) : 0;
      if (way_before(there) + way_before(here) - joined - way(begin, to) < least_gain_m) continue;
      turn(there, here);
      return true;
    }
    return false;
  }

  /// Between two others a part of the order, as it is or turned.
  struct Move {
    double gain_m = least_gain_m;
    std::size_t after = 0;  ///< this place
    bool is_turned = false;
  };

  /// Some arcs that follow each other, this one the first, to where one of their ends is near.
  bool move(std::uint32_t arc, std::size_t count) {
    const std::size_t first = place_[arc], end = first + count;
    if (end > order_.size()) return false;
    const std::uint32_t in = order_[first], out = end_of(end - 1);
    const double joined = first > 0 && end < order_.size() ? way(end_of(first - 1), order_[end]) : 0,
                 saved = way_before(first) + way_after(end - 1) - joined;
    Move best;
    look_beside(first, end, in, out, saved, best);
    look_beside(first, end, out, in, saved, best);
    if (best.gain_m <= least_gain_m) return false;
    if (best.is_turned) turn(first, end);
    if (best.after >= end) {
      std::rotate(iterator(first), iterator(end), iterator(best.after + 1));
      set_places(first, best.after + 1);
    } else {
      std::rotate(iterator(best.after + 1), iterator(first), iterator(end));
      set_places(best.after + 1, end);
    }
    return true;
  }

  /// With one end of what is from `first` up to `end` beside an end that is near to it.
  void look_beside(std::size_t first, std::size_t end, std::uint32_t near_end, std::uint32_t far_end, double saved,
                   Move& best) const {
    for (const std::uint32_t to : near_[near_end]) {
      if (way(near_end, to) >= saved) return;
      const std::size_t there = place_[to / 2];
      const bool comes_after = end_of(there) == to;
      if (!comes_after && there == 0) continue;
      const std::size_t after = comes_after ? there : there - 1;
      // It is there already.
      if (after + 1 >= first && after < end) continue;
      const double gain = saved + way_after(after) - way(to, near_end) - way_to_far_end(after, far_end, comes_after);
      if (gain > best.gain_m) best = {gain, after, comes_after != (near_end == order_[first])};
    }
  }
  /// Of what comes after a place, its near end first or last.
  double way_to_far_end(std::size_t after, std::uint32_t far_end, bool near_first) const {
    if (!near_first) return way(end_of(after), far_end);
    return after + 1 < order_.size() ? way(far_end, order_[after + 1]) : 0;
  }

  std::vector<Vec3> ends_;
  std::vector<std::vector<std::uint32_t>> near_;  ///< of each end, the nearest first
  double box_edge_ = 1;
  std::vector<std::uint32_t> order_;
  std::vector<std::size_t> place_;  ///< of each arc
};

}  // namespace

std::vector<Contour> tour_of(const std::vector<Contour>& contours, double near_m) {
  const std::vector<Contour> arcs = cut_where_near(contours, near_m);
  if (arcs.empty()) return {};
  std::vector<Contour> tour;
  for (const std::uint32_t end : Order(arcs).run()) {
    Contour next = arcs[end / 2];
    if (end % 2 == 1) std::ranges::reverse(next);
    if (!tour.empty() && tour.back().back() == next.front())
      tour.back().insert(tour.back().end(), next.begin() + 1, next.end());
    else
      tour.push_back(std::move(next));
  }
  return tour;
}

}  // namespace sculpt
