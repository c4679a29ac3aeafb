// Made-up plans with milling tools whose cuts remove what they say: meaningless motion, but straight ways of cutters.
#pragma once

#include <vector>

#include "core/base/random.hpp"
#include "core/material/voxel_set.hpp"
#include "core/trajectory/milling/swept_voxels.hpp"
#include "tests/core/trajectory/random_trajectory.hpp"

namespace sculpt {

struct MilledPlan {
  TrajectoryHeader header;
  std::vector<Keyframe> keyframes;
  std::vector<VoxelSet> removed;  ///< by each of them
};

inline TrajectoryHeader milled_header() {
  TrajectoryHeader header = sample_header();
  const auto tool = [](const char* name, const Cutter& cutter) {
    return MillTool{name, 1, cutter, {{0.08, 0.01, 0.01}}, 0.1, 0.01, 0.01, 0.1, {}, {}};
  };
  header.mill =
      MillHeader{{tool("D40", {CutterKind::ball, 0.02, 0.02, 0.06}), tool("flat", {CutterKind::flat, 0.012, 0, 0.04})},
                 {{0, 0, 1}, {26, 0, -15}, {1, 1, 1}},
                 2e-5,
                 std::string(64, 'a')};
  return header;
}

/// Carried out on `stock`, voxel by voxel.
inline MilledPlan random_milled(std::uint64_t seed, const VoxelSet& stock, int count) {
  Random random(seed);
  MilledPlan plan{milled_header(), {}, {}};
  const MillHeader& mill = *plan.header.mill;
  const VoxelCentres centres(plan.header.grid);
  VoxelSet standing = stock;
  std::size_t tool = 0;
  MillStep before;
  while (static_cast<int>(plan.keyframes.size()) < count) {
    Keyframe keyframe;
    keyframe.q = Configuration::Zero(plan.header.home.size());
    MillStep& step = keyframe.mill.emplace();
    VoxelSet gone(stock.n());
    const auto kind = random.next() % 16;
    if (kind == 0) {
      tool = random.next() % mill.tools.size();
      step.tool = static_cast<int>(tool);
    } else if (kind > 1) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        step.tip[axis] =
            quanta_of(plan.header.grid.origin_m)[axis] + static_cast<std::int64_t>(random.next() % 2'000'000);
      step.direction = static_cast<int>(random.next() % mill.directions.size());
      if (before.is_placed() && kind > 5) {
        keyframe.cut = true;
        step.direction = before.direction;
        if (kind > 8)  // a short way
          for (std::size_t axis = 0; axis < 3; ++axis)
            step.tip[axis] = before.tip[axis] + static_cast<std::int64_t>(random.next() % 200'000) - 100'000;
        const SweptCutter cutter(mill.tools[tool].cutter, mill.directions[static_cast<std::size_t>(step.direction)],
                                 mill.stray_m);
        for_each_voxel(standing, [&](Voxel v) {
          if (cutter.sweeps(before.tip, step.tip, {centres.at(0, v.i), centres.at(1, v.j), centres.at(2, v.k)}))
            gone.insert(v);
        });
        standing -= gone;
        step.removed = static_cast<std::uint32_t>(gone.size());
      }
    }
    before = step;
    plan.keyframes.push_back(std::move(keyframe));
    plan.removed.push_back(std::move(gone));
  }
  return plan;
}

}  // namespace sculpt
