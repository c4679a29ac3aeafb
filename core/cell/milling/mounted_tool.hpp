// A cell with a milling tool in its spindle.
#pragma once

#include <vector>

#include "core/cell/cell.hpp"
#include "core/cell/milling/mill_tool.hpp"

namespace sculpt {

/// The tool's body and cutter as cylinders in the tool link's frame; the cutter first.
std::vector<Shape> tool_shapes(const MillTool& tool);

/// What a chain is asked about is the tool's tip, and nothing but that.
ToolSpec tip_of(const MillTool& tool);

/// `cell` with the tool as part of its tool link: whoever looks at links sees it whole. The controlled point is the
/// tip.
Cell carrying(const Cell& cell, const MillTool& tool);

}  // namespace sculpt
