#include "core/verify/free_ranges.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {
namespace {

constexpr double whole_width = 8;
constexpr int max_depth = 12;
/// A range is asked for in so many cells, or up to two more; where one of them is not free its parts may be.
constexpr double cells_a_range = 4;
constexpr int finer_by = 3;

double width_at(int depth) {
  return std::ldexp(whole_width, -depth);
}

}  // namespace

bool FreeRanges::hold(double low, double high, const IsFree& is_free) {
  int depth = 0;
  while (depth < max_depth && cells_a_range * width_at(depth) > high - low) ++depth;
  const double width = width_at(depth);
  const auto first = static_cast<std::int64_t>(std::floor(low / width)),
             last = static_cast<std::int64_t>(std::floor(high / width));
  for (std::int64_t at = first; at <= last; ++at)
    if (!hold_whole({depth, at}, is_free)) return false;
  return true;
}

bool FreeRanges::hold_whole(const Cell& cell, const IsFree& is_free) {
  const auto known = whole_.find(cell);
  if (known != whole_.end()) return known->second;
  return whole_[cell] = hold_parts(cell, finer_by, is_free);
}

bool FreeRanges::hold_parts(const Cell& cell, int deeper, const IsFree& is_free) {
  if (ask(cell, is_free)) return true;
  if (deeper == 0) return false;
  const auto& [depth, at] = cell;
  return hold_parts({depth + 1, 2 * at}, deeper - 1, is_free) &&
         hold_parts({depth + 1, 2 * at + 1}, deeper - 1, is_free);
}

bool FreeRanges::ask(const Cell& cell, const IsFree& is_free) {
  const auto known = asked_.find(cell);
  if (known != asked_.end()) return known->second;
  const double width = width_at(cell.first);
  return asked_[cell] = is_free((static_cast<double>(cell.second) + 0.5) * width, width / 2);
}

}  // namespace sculpt
