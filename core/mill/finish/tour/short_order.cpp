#include "core/mill/finish/tour/short_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/base/random.hpp"
#include "core/mill/finish/tour/arc_order.hpp"
#include "core/mill/finish/tour/place_boxes.hpp"

namespace sculpt {
namespace {

constexpr std::size_t neighbours_kept = 10, most_moved = 3;
/// Ways are not made better by less (m).
constexpr double least_gain_m = 1e-9;
/// So often for each arc two parts of the order are swapped that are within so many places.
constexpr std::size_t swaps_an_arc = 4, swapped_within = 50;

/// Of all ends, those of other arcs that are nearest, the nearest first.
struct NearEnds {
  std::vector<std::vector<std::uint32_t>> of;
  double box_edge_m = 0;  ///< none that is nearer than this is missing, if there is one
};

NearEnds find_near(const std::vector<Vec3>& ends) {
  Eigen::AlignedBox3d box;
  for (const Vec3& end : ends) box.extend(end);
  NearEnds near{std::vector<std::vector<std::uint32_t>>(ends.size()),
                std::max(1e-6, box.sizes().maxCoeff() / std::sqrt(static_cast<double>(ends.size())))};
  const PlaceBoxes boxes(ends, near.box_edge_m);
  for (std::uint32_t end = 0; end < ends.size(); ++end) {
    std::vector<std::pair<double, std::uint32_t>> found;
    for (std::int64_t away = 1; away <= 4 && found.size() < neighbours_kept; away *= 2) {
      found.clear();
      boxes.for_each_near(ends[end], away, [&](std::uint32_t to) {
        if (to / 2 != end / 2) found.emplace_back((ends[end] - ends[to]).norm(), to);
      });
    }
    std::ranges::sort(found);
    found.resize(std::min(found.size(), neighbours_kept));
    for (const auto& [far, to] : found) near.of[end].push_back(to);
  }
  return near;
}

std::vector<std::uint32_t> nearest_next(const std::vector<Vec3>& ends, const NearEnds& near) {
  std::vector<std::uint32_t> order;
  std::vector<char> is_left(ends.size() / 2, 1);
  std::vector<std::uint32_t> rest(ends.size());
  std::iota(rest.begin(), rest.end(), 0);
  std::uint32_t next = 0;
  for (double least = 0; std::isfinite(least);) {
    order.push_back(next);
    is_left[next / 2] = 0;
    const std::uint32_t from = next ^ 1U;
    least = std::numeric_limits<double>::infinity();
    const auto look = [&](std::uint32_t to) {
      if (is_left[to / 2] == 0) return;
      if (const double far = (ends[from] - ends[to]).norm(); far < least) least = far, next = to;
    };
    std::ranges::for_each(near.of[from], look);
    if (least < near.box_edge_m) continue;
    std::erase_if(rest, [&](std::uint32_t end) { return is_left[end / 2] == 0; });
    std::ranges::for_each(rest, look);
  }
  return order;
}

class LocalSearch {
 public:
  LocalSearch(const NearEnds& near, ArcOrder order) : near_(near), order_(std::move(order)), is_due_(order_.size()) {}

  std::vector<std::uint32_t> run() {
    for (std::size_t place = 0; place < order_.size(); ++place) add_due(place);
    descend();
    order_.keep();
    Random random(order_.size());
    const std::size_t swaps = order_.size() < 2 * most_moved ? 0 : swaps_an_arc * order_.size();
    for (std::size_t number = 0; number < swaps; ++number) {
      const double gain = swap_some(random);
      gain + descend() < 0 ? order_.undo() : order_.keep();
    }
    return order_.order();
  }

 private:
  /// Around it ways may be made better.
  void add_due(std::size_t place) {
    if (place >= order_.size() || is_due_[order_.arc(place)] != 0) return;
    due_.push_back(order_.arc(place));
    is_due_[order_.arc(place)] = 1;
  }
  void add_due_around(std::size_t place) {
    if (place > 0) add_due(place - 1);
    add_due(place);
  }

  /// Until nothing is better; gives by how much ways are shorter (m).
  double descend() {
    double sum = 0;
    for (std::size_t next = 0; next < due_.size(); ++next) {
      const std::uint32_t arc = due_[next];
      is_due_[arc] = 0;
      for (double gain = 1; gain > 0; sum += gain) gain = improve(arc);
    }
    due_.clear();
    return sum;
  }

  /// 0 where nothing is better.
  double improve(std::uint32_t arc) {
    if (const double gain = turn_after(arc); gain > 0) return gain;
    if (const double gain = turn_before(arc); gain > 0) return gain;
    // The first or the last of some.
    for (std::size_t count = 1; count <= most_moved; ++count)
      for (std::size_t before = 0; before < count; before += std::max<std::size_t>(1, count - 1))
        if (const double gain = move(arc, before, count); gain > 0) return gain;
    return 0;
  }

  double turn(std::size_t first, std::size_t end, double gain) {
    order_.turn(first, end);
    add_due_around(first);
    add_due_around(end);
    return gain;
  }

  /// From the end of an arc to that of a later one: what is behind it up to that one is turned.
  double turn_after(std::uint32_t arc) {
    const std::size_t here = order_.place(arc);
    const std::uint32_t end = order_.end_of(here);
    for (const std::uint32_t to : near_.of[end]) {
      const double won = order_.way_after(here) - order_.way(end, to);
      if (won < least_gain_m) return 0;
      const std::size_t there = order_.place(to / 2);
      if (there <= here || order_.end_of(there) != to) continue;
      const double joined =
          there + 1 < order_.size() ? order_.way(order_.begin_of(here + 1), order_.begin_of(there + 1)) : 0;
      if (const double gain = won + order_.way_after(there) - joined; gain >= least_gain_m)
        return turn(here + 1, there + 1, gain);
    }
    return 0;
  }

  /// From the beginning of an earlier arc to that of this one: what is before it from that one on is turned.
  double turn_before(std::uint32_t arc) {
    const std::size_t here = order_.place(arc);
    const std::uint32_t begin = order_.begin_of(here);
    for (const std::uint32_t to : near_.of[begin]) {
      const double won = order_.way_before(here) - order_.way(begin, to);
      if (won < least_gain_m) return 0;
      const std::size_t there = order_.place(to / 2);
      if (there >= here || order_.begin_of(there) != to) continue;
      const double joined = there > 0 ? order_.way(order_.end_of(there - 1), order_.end_of(here - 1)) : 0;
      if (const double gain = won + order_.way_before(there) - joined; gain >= least_gain_m)
        return turn(there, here, gain);
    }
    return 0;
  }

  /// Between two others a part of the order, as it is or turned.
  struct Move {
    double gain_m = least_gain_m;
    std::size_t after = 0;  ///< this place
    bool is_turned = false;
  };

  /// Some arcs that follow each other, so many of them before this one, to where one of their ends is near.
  double move(std::uint32_t arc, std::size_t before, std::size_t count) {
    if (order_.place(arc) < before) return 0;
    const std::size_t first = order_.place(arc) - before, end = first + count;
    if (end > order_.size()) return 0;
    const std::uint32_t in = order_.begin_of(first), out = order_.end_of(end - 1);
    const double joined =
                     first > 0 && end < order_.size() ? order_.way(order_.end_of(first - 1), order_.begin_of(end)) : 0,
                 saved = order_.way_before(first) + order_.way_after(end - 1) - joined;
    Move best;
    look_beside(first, end, in, out, saved, best);
    look_beside(first, end, out, in, saved, best);
    if (best.gain_m <= least_gain_m) return 0;
    if (best.is_turned) order_.turn(first, end);
    const bool is_later = best.after >= end;
    if (is_later)
      order_.swap(first, end, best.after + 1);
    else
      order_.swap(best.after + 1, first, end);
    const std::size_t now = is_later ? best.after + 1 - count : best.after + 1;
    for (const std::size_t place : {is_later ? first : end, now, now + count}) add_due_around(place);
    return best.gain_m;
  }

  /// With one end of what is from `first` up to `end` beside an end that is near to it.
  void look_beside(std::size_t first, std::size_t end, std::uint32_t near_end, std::uint32_t far_end, double saved,
                   Move& best) const {
    for (const std::uint32_t to : near_.of[near_end]) {
      const double way = order_.way(to, near_end);
      if (way >= saved) return;
      const std::size_t there = order_.place(to / 2);
      const bool comes_after = order_.end_of(there) == to;
      if (!comes_after && there == 0) continue;
      const std::size_t after = comes_after ? there : there - 1;
      // It is there already.
      if (after + 1 >= first && after < end) continue;
      const double gain = saved + order_.way_after(after) - way - way_to_far_end(after, far_end, comes_after);
      if (gain > best.gain_m) best = {gain, after, comes_after != (near_end == order_.begin_of(first))};
    }
  }
  /// Of what comes after a place, its near end first or last.
  double way_to_far_end(std::size_t after, std::uint32_t far_end, bool near_first) const {
    if (!near_first) return order_.way(order_.end_of(after), far_end);
    return after + 1 < order_.size() ? order_.way(far_end, order_.begin_of(after + 1)) : 0;
  }

  /// Two parts, one behind the other, change places; gives by how much ways are shorter then: mostly less than 0.
  double swap_some(Random& random) {
    const std::size_t window = std::min(swapped_within, order_.size());
    const auto some = [&](std::size_t below) {
      return std::min(below - 1, static_cast<std::size_t>(random.unit() * static_cast<double>(below)));
    };
    const std::size_t begin = some(order_.size() - window + 1);
    std::array<std::size_t, 3> at{begin + some(window), begin + some(window), begin + some(window)};
    std::ranges::sort(at);
    const std::size_t first = at[0], middle = at[1], end = at[2];
    if (first == middle || middle == end) return 0;
    const std::size_t joint = first + (end - middle);
    const auto ways = [&](std::size_t third) {
      return order_.way_before(first) + order_.way_before(third) + order_.way_before(end);
    };
    const double before = ways(middle);
    order_.swap(first, middle, end);
    for (const std::size_t place : {first, joint, end}) add_due_around(place);
    return before - ways(joint);
  }

  const NearEnds& near_;
  ArcOrder order_;
  std::vector<std::uint32_t> due_;
  std::vector<char> is_due_;  ///< of each arc
};

}  // namespace

std::vector<std::uint32_t> short_order(const std::vector<Contour>& arcs) {
  std::vector<Vec3> ends;
  ends.reserve(2 * arcs.size());
  for (const Contour& arc : arcs) ends.insert(ends.end(), {arc.front(), arc.back()});
  const NearEnds near = find_near(ends);
  ArcOrder order(ends, nearest_next(ends, near));
  return LocalSearch(near, std::move(order)).run();
}

}  // namespace sculpt
