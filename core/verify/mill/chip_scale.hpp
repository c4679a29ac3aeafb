// Are the chips of level cuts as thick as the tool may take them? Internal to verify/.
#pragma once

#include <deque>
#include <string>
#include <utility>

#include "core/cell/milling/mill_tool.hpp"

namespace sculpt {

/// Weighed over a diameter of path, as what is taken off is known by whole voxels only.
class ChipScale {
 public:
  /// Of the next cut; lengths in mm. A sentence if the last ones together are too heavy.
  std::string weigh(const MillTool& tool, std::uint64_t voxels, double voxel_mm, double length);
  /// The next cut has nothing to do with those before.
  void end();

 private:
  std::deque<std::pair<double, double>> chips_;  ///< volumes (mm^3) and lengths (mm)
  double volume_ = 0, length_ = 0;
};

}  // namespace sculpt
