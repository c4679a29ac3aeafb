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

  /// Goes from `home` to `entry` (a voxel position, maybe outside the grid). Throws InputError `no_transit` when a
  /// straight line between the two is not free: then the cell's home has to be moved.
  Gantry(Scene& scene, const Configuration& home, Voxel entry, Emit emit);

  /// Throws InputError `stock_out_of_reach` where the joints do not reach, `no_transit` where something of the room is
  /// in the way.
  void follow(const VoxelRun& run);
  void go_home();

 private:
  Configuration configuration_at(Voxel voxel) const;
  void cut(Voxel first, Voxel last);
  void move(const Configuration& q);

  Scene& scene_;
  Configuration home_, q_;
  Voxel at_;
  Emit emit_;
};

}  // namespace sculpt
