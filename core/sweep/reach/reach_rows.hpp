// Where the ball may be along one tool direction, for links and limits: rows of bits.
#pragma once

#include <functional>
#include <vector>

#include "core/sweep/reach/cell_rows.hpp"

namespace sculpt {

/// Cells of a view, and those of the layer above it, that are reachable. Reads from several threads are safe.
class ReachRows {
 public:
  /// `part` is what a cell belongs to: each of its coordinates depends on that coordinate of the cell alone and never
  /// falls. `reachable` says it of all cells of a part.
  ReachRows(int n, const std::function<Voxel(const Vec3& cell)>& part,
            const std::function<bool(Voxel part)>& reachable);

  const std::uint64_t* row(int b, int c) const {
    return rows_.row(row_of_[static_cast<std::size_t>(b)], layer_of_[static_cast<std::size_t>(c)]);
  }

 private:
  std::vector<int> row_of_, layer_of_;  ///< equal ones are kept once
  CellRows rows_;
};

}  // namespace sculpt
