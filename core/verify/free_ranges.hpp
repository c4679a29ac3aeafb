// Where along one coordinate two things cannot touch. Internal to verify/.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <utility>

namespace sculpt {

/// Things that only one coordinate moves against each other are asked about over cells of it, once each: 8 rad or m
/// wide, halves of those, and so on. What is said of a range depends on nothing but the range.
class FreeRanges {
 public:
  /// Whether they surely touch nowhere within `half` of `middle`.
  using IsFree = std::function<bool(double middle, double half)>;

  /// The same of [low, high]; `is_free` is asked of what was not asked about before.
  bool hold(double low, double high, const IsFree& is_free);

 private:
  using Cell = std::pair<int, std::int64_t>;  // depth; its number

  bool hold_whole(const Cell& cell, const IsFree& is_free);
  bool hold_parts(const Cell& cell, int deeper, const IsFree& is_free);
  bool ask(const Cell& cell, const IsFree& is_free);

  std::map<Cell, bool> asked_, whole_;
};

}  // namespace sculpt
