// What of the stock's top is to come off at a level.
#pragma once

#include <vector>

#include "core/cell/milling/mill_tool.hpp"
#include "core/mill/map/height_map.hpp"

namespace sculpt {

struct CellsToClear {
  std::vector<char> marked;  ///< by cell
  double volume_m3 = 0;      ///< about: of what is above the level there
};

/// What is higher than the cutter, its tip at `height` (m, tool frame), would leave it if it came to all cells where it
/// may be (`is_free`), by more than `cusp_m`.
CellsToClear find_cells_to_clear(const Cutter& cutter, double height, double cusp_m, const std::vector<char>& is_free,
                                 const HeightMap& tops, const Helpers& helpers);

}  // namespace sculpt
