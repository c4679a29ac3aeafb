// Where a translating robot can be, by positions of the ball in voxels.
#pragma once

#include <vector>

#include "core/base/watch.hpp"
#include "core/collision/scene.hpp"

namespace sculpt {

/// The positions in the grid, one beside it at the sides and one above it, at which the robot is out of its limits or
/// touches something; not material with the ball. Exact at the positions themselves, of which it asks one by one only
/// near what may be touched.
class Room {
 public:
  /// `seed`: where joint values are searched from. Throws Cancelled.
  Room(const Scene& scene, const Configuration& seed, const Watch& watch);

  bool is_open(Voxel position) const;
  const std::vector<Voxel>& closed() const { return closed_; }
  /// Looks again where material may have been touched. True if any position has opened.
  bool look_again(const Scene& scene);

 private:
  bool is_free(const Scene& scene, Voxel position) const;
  bool is_free(const Scene& scene, Voxel low, Voxel high) const;
  void look(const Scene& scene, Voxel corner, int size, const Watch& watch);

  Configuration seed_;
  std::vector<Voxel> closed_;  ///< sorted
};

}  // namespace sculpt
