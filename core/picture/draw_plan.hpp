// A moment of a plan, seen from one side: the stock, and the cell around it where there is one.
#pragma once

#include <string>
#include <vector>

#include "core/cell/cell.hpp"
#include "core/picture/canvas.hpp"
#include "core/picture/stock_moment.hpp"

namespace sculpt {

/// Sides that a plan can be drawn from: `corner` (from the front, the right and above), front (against +y), back, left,
/// right, top.
const std::vector<std::string>& picture_sides();

struct PlanPictureSettings {
  std::string side = "corner";  ///< one of picture_sides()
  int pixels = 640;             ///< along each edge
};

/// Raw surfaces of the stock are grey, cut ones light, what is left over red; light falls as on the smooth surface that
/// the voxels stand for. Without a cell one looks along the axes of the stock's frame, and the grid fills the picture;
/// with one (of the plan's joints, by name; moment.q must be known) along those of the room, with links as their
/// collision shapes. The same bytes on every machine. Throws InputError `cell_invalid` for a cell that lacks one of
/// these joints, std::invalid_argument for another side. Any thread.
Picture draw_plan(const StockMoment& moment, const Cell* cell, const PlanPictureSettings& settings);

}  // namespace sculpt
