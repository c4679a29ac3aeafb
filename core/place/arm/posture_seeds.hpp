// Configurations all over the joints' ranges, from which the arm is tried at every stand.
#pragma once

#include <cstdint>
#include <vector>

#include "core/cell/chain.hpp"

namespace sculpt {

/// Where the tool is at each configuration of PostureSeeds, for one chain (stock frame).
using SeedPoses = std::vector<ToolPose>;

/// Counted randomness; the same for every stand of a cell, whose chains differ in one fixed frame only. Immutable:
/// safe to share between threads.
class PostureSeeds {
 public:
  /// `home` is one of them.
  PostureSeeds(const Chain& chain, const Configuration& home, std::uint64_t seed);

  const std::vector<Configuration>& configurations() const { return configurations_; }
  SeedPoses poses(const Chain& chain) const;

  /// The numbers of the `most` seeds whose tool is nearest to a ball somewhere in the box and along `axis`, best first.
  /// Axes that are apart by as much as their length count as `lever_m`.
  static std::vector<std::size_t> nearest(const SeedPoses& poses, const Eigen::AlignedBox3d& balls_m, const Vec3& axis,
                                          double lever_m, std::size_t most);

 private:
  std::vector<Configuration> configurations_;
};

}  // namespace sculpt
