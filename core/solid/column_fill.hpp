// The crossings of a column -> what is inside along it.
#pragma once

#include <span>

#include "core/solid/crossings.hpp"
#include "core/solid/shells.hpp"

namespace sculpt {

/// Where a column goes through a facet, as one number that sorts by column of a row, then by depth.
class Crossing {
 public:
  Crossing(std::int64_t column, std::int64_t depth, int n, Role role, bool enters)
      : bits_(static_cast<std::uint32_t>(((column * (n + 1) + depth) << 4) | (static_cast<int>(role) << 1) | enters)) {}
  int column(int n) const { return static_cast<int>(bits_ >> 4) / (n + 1); }
  int depth(int n) const { return static_cast<int>(bits_ >> 4) % (n + 1); }
  Role role() const { return static_cast<Role>((bits_ >> 1) & 7); }
  int sign() const { return bits_ & 1 ? 1 : -1; }
  auto operator<=>(const Crossing&) const = default;

 private:
  std::uint32_t bits_;
};
static_assert(roles <= 8 && 1024 * 1025 < 1 << 28);

/// Flips the bits of `inside` where columns go in or out, and fills the rest of `out`.
class ColumnFill {
 public:
  ColumnFill(Crossings& out, int n, int axis);

  /// `crossings`: sorted, all of one column of the row, at least one.
  void add(std::span<const Crossing> crossings, std::int64_t row);

 private:
  void flip(std::int64_t a, std::int64_t row, int depth);
  void note(int a, std::int64_t row, int first, int last);

  Crossings& out_;
  std::int64_t n_;
  int axis_;
  std::size_t along_, across_a_, across_b_;
};

}  // namespace sculpt
