// What milling leaves to the report.
#pragma once

#include <vector>

#include "core/plan/report.hpp"

namespace sculpt {

/// Of a plan with milling tools, once all is cut: what its file does not say.
struct MilledFigures {
  std::vector<ToolFigures> tools;
  std::vector<Cure> cures;
  ExcessFigures reachable;
};

}  // namespace sculpt
