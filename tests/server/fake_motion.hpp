// A plan of one joint that a time law can be made for without a cell, and what the fake planner makes of the feed that
// is asked for.
#pragma once

#include <sstream>
#include <string>

#include "core/law/coarse.hpp"
#include "core/timing/plan_path.hpp"
#include "core/trajectory/writer.hpp"

namespace sculpt::server {

/// Joint "x" goes from 0 to 1 and back, over and over.
inline std::string fake_motion(int moves) {
  TrajectoryHeader header;
  header.joints = {"x"};
  header.home = Configuration::Zero(1);
  header.grid = {8, 0.01, Vec3::Zero()};
  header.tool = {0.004, 0, 0};
  header.tolerance_m = 0.0004;
  header.cell = "gantry";
  header.search = "octree";
  std::ostringstream out;
  TrajectoryWriter writer(out, header);
  for (int move = 1; move <= moves; ++move) {
    Keyframe keyframe;
    keyframe.q = Configuration::Constant(1, move % 2);
    writer.add(keyframe);
  }
  writer.finish();
  return out.str();
}

/// It rests at every keyframe; faster at a higher feed.
inline TimeLaw fake_law(const PlanPath& path, double feed_m_s) {
  TimeLaw law{{1}, 0.004, feed_m_s, 0.5, {}};
  law.corners.resize(path.keyframes(), {0, static_cast<float>(rounded_down(feed_m_s)), 0, 0, 0});
  return law;
}

// Feeds that are no feeds.
inline constexpr double feed_refused = 13, feed_crashes = 66, feed_endless = 99, feed_writes_none = 77,
                        feed_of_another_plan = 55;

}  // namespace sculpt::server
