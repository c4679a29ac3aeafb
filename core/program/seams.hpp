// Where a program may be parted, so that each part begins and ends with the tool outside the material. Internal to
// core/program.
#pragma once

#include <vector>

#include "core/program/part_size.hpp"
#include "core/timing/path_tool.hpp"

namespace sculpt {

/// Between two parts.
struct Seam {
  std::size_t point = 0;  ///< of the path: the last one of the part before it
  /// From there to where the tool is clear of the stock, and back again to begin the next part. Empty where it is so
  /// already.
  std::vector<Configuration> retreat;
};

/// In the order of the path; where a milling tool is changed there always is one. A thin tool leaves along its axis,
/// certified against all of the stock's cube that is not cut yet; a milling tool is parted from its work on a way over,
/// or climbs straight out. `tools` are those of `cell`.
/// Throws InputError `part_invalid` where no place to part was found that fits.
std::vector<Seam> find_seams(const PlanPath& path, const Cell& cell, const PathTools& tools, const PartSize& size);

}  // namespace sculpt
