// Made-up trajectories for the tests of this folder: valid lines, meaningless motion.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/random.hpp"
#include "core/trajectory/header.hpp"
#include "core/trajectory/keyframe.hpp"
#include "core/trajectory/quantum.hpp"
#include "core/trajectory/writer.hpp"

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

// Multiples of the quantum of any size, with zeros among them.
inline double random_stored_value(Random& random) {
  const auto quanta = static_cast<std::int64_t>(random.next() >> (14 + random.next() % 50)) % (max_quanta + 1);
  return from_quanta(random.next() % 2 == 0 ? quanta : -quanta);
}

enum class Values { any, stored };

inline Keyframe random_keyframe(Random& random, const TrajectoryHeader& header, Values values = Values::any) {
  Keyframe keyframe;
  keyframe.q.resize(header.home.size());
  for (double& value : keyframe.q) value = values == Values::any ? random_value(random) : random_stored_value(random);
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

inline std::vector<Keyframe> random_keyframes(std::uint64_t seed, const TrajectoryHeader& header,
                                              Values values = Values::any) {
  Random random(seed);
  std::vector<Keyframe> keyframes(random.next() % 200);
  for (Keyframe& keyframe : keyframes) keyframe = random_keyframe(random, header, values);
  return keyframes;
}

// Rows to and fro with a keyframe every `spacing` voxels, layer after layer, joints moving as smoothly as those of an
// arm do.
inline std::vector<Keyframe> smooth_rows(const TrajectoryHeader& header, int layers, int spacing) {
  std::vector<Keyframe> keyframes;
  const int n = header.grid.n;
  Voxel at{0, 0, n - 1};
  const auto cut = [&](Voxel first, Voxel last) {
    const Vec3 there = header.grid.centre(last);
    Configuration q(header.home.size());
    for (Eigen::Index joint = 0; joint < q.size(); ++joint)
      q[joint] = std::sin(1.3 * there.x() + 0.4 * static_cast<double>(joint)) + std::cos(2.1 * there.y()) * there.z() +
                 0.7 * there.y();
    keyframes.push_back({rounded(q), true, first, last});
    at = last;
  };
  cut(at, at);
  int side = 1, onward = 1;
  for (int layer = 0; layer < layers; ++layer, onward = -onward) {
    if (layer > 0) cut(at + Voxel{0, 0, -1}, at + Voxel{0, 0, -1});
    for (int row = 0; row < n; ++row, side = -side) {
      if (row > 0) cut(at + Voxel{onward, 0, 0}, at + Voxel{onward, 0, 0});
      for (int left = n - 1; left > 0; left -= spacing)
        cut(at + Voxel{0, side, 0}, at + Voxel{0, side * std::min(left, spacing), 0});
    }
  }
  return keyframes;
}

}  // namespace sculpt
