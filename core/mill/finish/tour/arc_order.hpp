// An order of arcs, which can be changed and changed back.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/frame.hpp"

namespace sculpt {

/// Arcs are straight or not: only their ends count. Ends 2 a and 2 a + 1 are those of arc a; it is gone along from one
/// to the other. Places count from 0. Not shared between threads.
class ArcOrder {
 public:
  /// `ends`: where they are (m). `order`: of each place the end where its arc begins.
  ArcOrder(std::vector<Vec3> ends, std::vector<std::uint32_t> order)
      : ends_(std::move(ends)), order_(std::move(order)), place_(order_.size()) {
    set_places(0, order_.size());
  }

  std::size_t size() const { return order_.size(); }
  const std::vector<std::uint32_t>& order() const { return order_; }
  std::uint32_t begin_of(std::size_t place) const { return order_[place]; }
  std::uint32_t end_of(std::size_t place) const { return order_[place] ^ 1U; }
  std::uint32_t arc(std::size_t place) const { return order_[place] / 2; }
  std::size_t place(std::uint32_t arc) const { return place_[arc]; }

  /// From one end to another (m).
  double way(std::uint32_t from, std::uint32_t to) const { return (ends_[from] - ends_[to]).norm(); }
  /// From the end of the arc in a place to the next one, and to it from the one before; 0 where there is none (m).
  double way_after(std::size_t place) const { return place + 1 < size() ? way(end_of(place), begin_of(place + 1)) : 0; }
  double way_before(std::size_t place) const { return place > 0 ? way_after(place - 1) : 0; }

  /// What is from `first` up to `end`, the other way around.
  void turn(std::size_t first, std::size_t end) {
    remember(first, end);
    std::reverse(iterator(first), iterator(end));
    for (std::size_t place = first; place < end; ++place) order_[place] ^= 1U;
    set_places(first, end);
  }
  /// What is from `first` up to `middle` goes behind what is from there up to `end`.
  void swap(std::size_t first, std::size_t middle, std::size_t end) {
    remember(first, end);
    std::rotate(iterator(first), iterator(middle), iterator(end));
    set_places(first, end);
  }

  /// All changes stay.
  void keep() {
    before_.clear();
    changes_.clear();
  }
  /// As it was when changes were last kept.
  void undo() {
    for (; !changes_.empty(); changes_.pop_back()) {
      const auto [first, count] = changes_.back();
      std::copy(before_.end() - static_cast<std::ptrdiff_t>(count), before_.end(), iterator(first));
      before_.resize(before_.size() - count);
      set_places(first, first + count);
    }
  }

 private:
  std::vector<std::uint32_t>::iterator iterator(std::size_t place) {
    return order_.begin() + static_cast<std::ptrdiff_t>(place);
  }
  void remember(std::size_t first, std::size_t end) {
    changes_.emplace_back(first, end - first);
    before_.insert(before_.end(), iterator(first), iterator(end));
  }
  void set_places(std::size_t first, std::size_t end) {
    for (std::size_t place = first; place < end; ++place) place_[arc(place)] = place;
  }

  std::vector<Vec3> ends_;
  std::vector<std::uint32_t> order_;
  std::vector<std::size_t> place_;                            ///< of each arc
  std::vector<std::uint32_t> before_;                         ///< what changes replaced, one after the other
  std::vector<std::pair<std::size_t, std::size_t>> changes_;  ///< from which place, and how many
};

}  // namespace sculpt
