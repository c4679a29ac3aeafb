// Progress out, cancel in: the one object that every long stage is handed.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <stop_token>

#include "core/base/error.hpp"

namespace sculpt {

enum class Stage { load, voxelize, octree, plan, verify, write };

/// What a user should look at before the plan is used, in voxels; known from the first step of `plan` on.
struct Doubts {
  std::uint64_t keep = 0;                   ///< the target
  std::uint64_t loose_keep = 0;             ///< of it: what hangs on nothing
  std::uint64_t ambiguous = 0;              ///< the mesh does not say for sure whether they are inside
  std::array<double, 3> ambiguous_at_mm{};  ///< the middle of the box around those, in the stock's frame

  bool is_much_loose() const { return loose_keep >= 1000 || (loose_keep > 0 && 50 * loose_keep >= keep); }
};

/// Plain counts of the running stage; done <= total.
struct Progress {
  Stage stage = Stage::load;
  std::uint64_t done = 0;
  std::uint64_t total = 0;
  Doubts doubts{};
};

/// Copyable. `tell` is called on the thread that does the work, as often as the work likes: receivers thin it out.
struct Watch {
  std::stop_token stop;
  std::function<void(const Progress&)> tell;
  Doubts doubts{};  ///< told with every step

  /// Reports, and throws `Cancelled` if a stop was requested. Cheap enough for every voxel row, block or node.
  void step(Stage stage, std::uint64_t done, std::uint64_t total) const {
    if (stop.stop_requested()) throw Cancelled{};
    if (tell) tell({stage, done, total, doubts});
  }
};

constexpr const char* name(Stage stage) {
  switch (stage) {
    case Stage::load:
      return "load";
    case Stage::voxelize:
      return "voxelize";
    case Stage::octree:
      return "octree";
    case Stage::plan:
      return "plan";
    case Stage::verify:
      return "verify";
    case Stage::write:
      return "write";
  }
  return "unknown";
}

}  // namespace sculpt
