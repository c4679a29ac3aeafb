// Voxel runs of the translating robot -> certified keyframes.
#pragma once

#include <functional>

#include "core/collision/scene.hpp"
#include "core/search/translating.hpp"
#include "core/trajectory/trajectory.hpp"

namespace sculpt {

/// Follows runs with a chain of prismatic joints. `scene` loses the voxels that are cut. Single-threaded.
class Gantry {
 public:
  using Emit = std::function<void(const Keyframe&)>;

  /// Stands at `home`; goes to `entry` (a voxel position, maybe outside the grid) before it follows the first run. The
  /// first `known` keyframes were certified and emitted by another one that followed the same runs: this is not done
  /// again.
  Gantry(Scene& scene, const Configuration& home, Voxel entry, Emit emit, std::uint64_t known = 0);

  /// Throws InputError `stock_out_of_reach` where the joints do not reach, `no_transit` where something of the room is
  /// in the way; at the first run also of the straight line from home to the entry, then the cell's home has to be
  /// moved.
  void follow(const VoxelRun& run);
  void go_home();

 private:
  Configuration configuration_at(Voxel voxel) const;
  void cut(Voxel first, Voxel last);
  void move(const Configuration& q);
  Contact certify(const Configuration& from, const Configuration& to, std::optional<Voxel> exempt = {}) const;
  void emit(const Keyframe& keyframe);

  Scene& scene_;
  Configuration home_, q_;
  Voxel at_;
  bool entered_ = false;
  Emit emit_;
  std::uint64_t known_;  ///< keyframes yet to come that are known
};

}  // namespace sculpt
