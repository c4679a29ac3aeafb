// What the passes of a sweep work on, and how one ended.
#pragma once

#include "core/base/run_context.hpp"
#include "core/material/support/support.hpp"
#include "core/sweep/hub_arm.hpp"

namespace sculpt {

struct Carving {
  const Scene& scene;
  const VoxelSet& keep;
  RunContext run;
  Support support;  ///< of what stands when all that is planned is cut
  HubArm arm;
};

struct PassEnd {
  bool cut = false;     ///< something
  bool spared = false;  ///< something was left lest a piece come free
};

}  // namespace sculpt
