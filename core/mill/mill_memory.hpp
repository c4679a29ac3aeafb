// What milling has to know to go on, besides what its keyframes say.
#pragma once

#include <vector>

#include "core/mill/drive/mill_arm.hpp"
#include "core/mill/mill_cuts.hpp"
#include "core/mill/tool_figures.hpp"

namespace sculpt {

/// When a tool was put in and the arm is at home with it, before it cuts anything.
struct MillMemory {
  std::vector<ToolFigures> tools;  ///< of all until then; the last one is that in the spindle
  MillArmMemory arm;
  std::vector<char> reachable;  ///< of each nail: 1 if a tool could come to it
};

/// Where a run goes on that another one began, and all that was cut until then.
struct MillStart {
  MillMemory memory;
  std::vector<MillCuts> cuts;
};

}  // namespace sculpt
