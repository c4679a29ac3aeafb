#include "core/solid/column_fill.hpp"

#include <algorithm>
#include <cstdlib>

namespace sculpt {
namespace {

/// What is known at a place in a column: how often each role winds round it, and how many crossings there were.
class Winding {
 public:
  void add(Crossing crossing) {
    turns_[static_cast<std::size_t>(crossing.role())] += crossing.sign();
    ++crossings_;
    unturned_ += crossing.role() == Role::unturned;
  }
  bool is_odd() const { return crossings_ % 2 != 0; }
  bool is_balanced() const {
    return of(Role::solid) + of(Role::doubtful_solid) == 0 && of(Role::cavity) + of(Role::doubtful_cavity) == 0;
  }
  /// Of the facets whose turn is left to chance too.
  bool all_cancel() const { return is_balanced() && of(Role::unturned) == 0; }
  bool is_inside() const { return more_solid(0) || unturned_ % 2 != 0; }
  bool is_doubtful() const {
    const bool in_doubt = of(Role::doubtful_solid) != 0 || of(Role::doubtful_cavity) != 0 || of(Role::unturned) != 0 ||
                          unturned_ % 2 != 0;
    return in_doubt && more_solid(of(Role::unturned)) != is_odd();
  }

 private:
  int of(Role role) const { return turns_[static_cast<std::size_t>(role)]; }
  bool more_solid(int unturned) const {
    return std::abs(of(Role::solid) + of(Role::doubtful_solid) + unturned) >
           std::abs(of(Role::cavity) + of(Role::doubtful_cavity));
  }

  std::array<int, roles> turns_{};
  int crossings_ = 0, unturned_ = 0;
};

}  // namespace

ColumnFill::ColumnFill(Crossings& out, int n, int axis) : out_(out), n_(n), axis_(axis) {
  const std::array<std::size_t, 3> stride{1, static_cast<std::size_t>(n), static_cast<std::size_t>(n) * n};
  along_ = stride[axis];
  across_a_ = stride[(axis + 1) % 3];
  across_b_ = stride[(axis + 2) % 3];
}

void ColumnFill::add(std::span<const Crossing> crossings, std::int64_t row) {
  const int a = crossings[0].column(n_);
  const std::size_t column = static_cast<std::size_t>(a + n_ * row);
  Winding all;
  for (const Crossing& crossing : crossings) all.add(crossing);
  out_.met[column >> 6] |= std::uint64_t{1} << (column & 63);
  if (all.is_odd()) out_.odd[column >> 6] |= std::uint64_t{1} << (column & 63);
  const bool by_sign = !all.is_odd() && all.is_balanced();
  out_.unbalanced += !all.is_odd() && !all.is_balanced();
  Winding here;
  bool inside = false;
  for (std::size_t at = 0; at < crossings.size(); ++at) {
    here.add(crossings[at]);
    const int depth = crossings[at].depth(n_);
    const int next = at + 1 < crossings.size() ? crossings[at + 1].depth(n_) : n_;
    if (next == depth) continue;
    if (inside != (by_sign ? here.is_inside() : here.is_odd())) flip(a, row, depth);
    inside = by_sign ? here.is_inside() : here.is_odd();
    if (by_sign && all.all_cancel() && here.is_doubtful()) note(a, row, depth, next - 1);
  }
}

void ColumnFill::flip(std::int64_t a, std::int64_t row, int depth) {
  const std::size_t at = a * across_a_ + row * across_b_ + depth * along_;
  out_.inside.words()[at >> 6] ^= std::uint64_t{1} << (at & 63);
}

void ColumnFill::note(int a, std::int64_t row, int first, int last) {
  std::array<int, 3> low{}, high{};
  low[axis_] = first;
  high[axis_] = last;
  low[(axis_ + 1) % 3] = high[(axis_ + 1) % 3] = a;
  low[(axis_ + 2) % 3] = high[(axis_ + 2) % 3] = static_cast<int>(row);
  Ambiguous& known = out_.ambiguous;
  const bool is_first = known.voxels == 0;
  known.voxels += static_cast<std::uint64_t>(last - first + 1);
  const auto extend = [&](int& out_low, int& out_high, int axis) {
    out_low = is_first ? low[axis] : std::min(out_low, low[axis]);
    out_high = is_first ? high[axis] : std::max(out_high, high[axis]);
  };
  extend(known.low.i, known.high.i, 0);
  extend(known.low.j, known.high.j, 1);
  extend(known.low.k, known.high.k, 2);
}

}  // namespace sculpt
