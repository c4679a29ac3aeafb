// Paths in joint space that no planner made: certified by nobody, but a law must keep its limits on any of them.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "core/base/random.hpp"
#include "core/timing/plan_path.hpp"
#include "core/trajectory/quantum.hpp"
#include "core/trajectory/writer.hpp"
#include "tests/core/cell/sample_robots.hpp"

namespace sculpt {

inline PlanPath path_of(const Cell& cell, const std::vector<Keyframe>& keyframes, int resolution = 16) {
  const Chain chain = cell.chain();
  TrajectoryHeader header;
  header.joints = chain.names();
  header.home = cell.home(chain);
  header.grid = cell.grid(resolution);
  header.tool = make_tool(cell.tool, header.grid.voxel_m);
  header.tolerance_m = 0.04 * header.grid.voxel_m;
  header.cell = cell.name;
  header.search = "sweep";
  std::ostringstream out;
  TrajectoryWriter writer(out, header);
  for (const Keyframe& keyframe : keyframes) writer.add(keyframe);
  writer.finish();
  std::istringstream in(out.str());
  return PlanPath(in);
}

/// Steps of all sizes, straight on, sideways, back the same way, and none at all; some of them cut.
inline std::vector<Keyframe> wander(const Cell& cell, Random& random, std::size_t count) {
  const Chain chain = cell.chain();
  std::vector<Keyframe> keyframes;
  Configuration at = cell.home(chain), step = Configuration::Zero(at.size());
  while (keyframes.size() < count) {
    switch (random.next() % 8) {
      case 0:
        step = -step;
        break;
      case 1:
        step.setZero();
        break;
      case 2:
      case 3:
        break;  // straight on
      default:
        for (double& value : step) value = std::pow(10, random.between(-7, -1)) * random.between(-1, 1);
    }
    Keyframe keyframe;
    keyframe.q = rounded((at + step).cwiseMax(chain.lower()).cwiseMin(chain.upper()), chain.lower(), chain.upper());
    keyframe.cut = random.next() % 2 == 0;
    if (keyframe.cut) keyframe.first = keyframe.last = {static_cast<int>(random.next() % 8), 3, 4};
    step = keyframe.q - at;
    at = keyframe.q;
    keyframes.push_back(keyframe);
  }
  return keyframes;
}

}  // namespace sculpt
