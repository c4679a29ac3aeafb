// Through the air where no straight way over leads: around what the arm does not reach.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/mill/drive/reach_floor.hpp"
#include "core/mill/map/site.hpp"

namespace sculpt {

/// From one place, by breadth-first search over a lattice.
class AirWays {
 public:
  /// All of the tip (tool frame, m). Nowhere higher than `from`, nor lower than `lowest`, nor where a leg ended that
  /// the arm refused. Site and reach must outlive it.
  AirWays(const Site& site, const ReachFloor& reach, const Vec3& from, double lowest, const std::vector<Vec3>& refused);

  /// From straight below `from` to straight above `to`: each leg is level or upright, clear of all that stands, and its
  /// ends are in reach. Empty where none is found.
  std::vector<Vec3> to(const Vec3& to) const;

 private:
  using Cell = std::array<int, 3>;
  static constexpr std::int32_t closed = -3, unseen = -2, at_begin = -1;

  bool is_free(const Vec3& at) const;
  bool is_clear(const Vec3& a, const Vec3& b) const;
  Vec3 middle(const Cell& cell) const;
  bool is_inside(const Cell& cell) const;
  std::size_t index(const Cell& cell) const;
  Cell column(const Vec3& at, int layer) const;
  void begin();
  void look(const Cell& cell, const Vec3& from, std::int32_t number);
  void look_around(std::int32_t number);

  const Site& site_;
  const ReachFloor& reach_;
  Vec3 from_;
  std::array<int, 3> counts_{};
  std::vector<std::int32_t> before_;  ///< of each cell: the number of the one that it was come to from
  std::vector<std::int32_t> number_;  ///< of each cell that was come to
  std::vector<Cell> line_;            ///< in the order in which they were come to
};

}  // namespace sculpt
