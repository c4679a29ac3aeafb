// Made-up trajectories for the tests of this folder: valid lines, meaningless motion.
#pragma once

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/random.hpp"
#include "core/trajectory/trajectory.hpp"

namespace sculpt {

inline TrajectoryHeader sample_header() {
  TrajectoryHeader header;
  header.joints = {"slide", "panda \"joint\", 2", "gr\xc3\xbc\xc3\x9f"};
  header.home = Configuration::Zero(3);
  header.home << 0.1, -2.5, 1e-9;
  header.grid = {16, 0.2 / 16, Vec3(-0.1, -0.1, 1.0 / 3)};
  header.tool = {0.45 * 0.2 / 16, 0.4 * 0.2 / 16, 0.27};
  header.tolerance_m = 1e-4;
  header.cell = "panda-turntable";
  header.search = "octree";
  header.seed = 0xffffffffffffffffull;
  return header;
}

// Any finite double, not only sensible ones: every third has random bits.
inline double random_value(Random& random) {
  switch (random.next() % 3) {
    case 0:
      return rounded(Configuration::Constant(1, random.between(-7, 7)))[0];
    case 1:
      return random.between(-1e-5, 1e-5);
    default:
      break;
  }
  for (;;) {
    const auto value = std::bit_cast<double>(random.next());
    if (std::isfinite(value)) return value;
  }
}

inline Keyframe random_keyframe(Random& random, const TrajectoryHeader& header) {
  Keyframe keyframe;
  keyframe.q.resize(header.home.size());
  for (double& value : keyframe.q) value = random_value(random);
  keyframe.cut = random.next() % 2 == 0;
  if (!keyframe.cut) return keyframe;
  const int n = header.grid.n;
  const auto index = [&] { return static_cast<int>(random.next() % static_cast<std::uint64_t>(n)); };
  keyframe.first = keyframe.last = {index(), index(), index()};
  (random.next() % 2 == 0 ? keyframe.last.i : keyframe.last.k) = index();
  return keyframe;
}

inline std::string write_text(const TrajectoryHeader& header, const std::vector<Keyframe>& keyframes) {
  std::ostringstream out;
  TrajectoryWriter writer(out, header);
  for (const Keyframe& keyframe : keyframes) writer.add(keyframe);
  writer.finish();
  return out.str();
}

inline std::vector<Keyframe> random_keyframes(std::uint64_t seed, const TrajectoryHeader& header) {
  Random random(seed);
  std::vector<Keyframe> keyframes(random.next() % 200);
  for (Keyframe& keyframe : keyframes) keyframe = random_keyframe(random, header);
  return keyframes;
}

}  // namespace sculpt
