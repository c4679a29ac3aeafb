#include "core/place/arm/posture_seeds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/motion/random_configuration.hpp"

namespace sculpt {
namespace {

constexpr int drawn = 2047;

}  // namespace

PostureSeeds::PostureSeeds(const Chain& chain, const Configuration& home, std::uint64_t seed) : configurations_{home} {
  Random random(seed);
  for (int at = 0; at < drawn; ++at) configurations_.push_back(random_configuration(chain, random));
}

SeedPoses PostureSeeds::poses(const Chain& chain) const {
  SeedPoses poses;
  poses.reserve(configurations_.size());
  for (const Configuration& q : configurations_) poses.push_back(chain.tool_pose(q));
  return poses;
}

std::vector<std::size_t> PostureSeeds::nearest(const SeedPoses& poses, const Eigen::AlignedBox3d& balls_m,
                                               const Vec3& axis, double lever_m, std::size_t most) {
  std::vector<std::pair<double, std::size_t>> costs;
  costs.reserve(poses.size());
  for (std::size_t at = 0; at < poses.size(); ++at) {
    const double off_m = std::sqrt(balls_m.squaredExteriorDistance(poses[at].ball_m));
    costs.emplace_back(off_m + lever_m * (poses[at].axis - axis).norm(), at);
  }
  const auto end = costs.begin() + static_cast<std::ptrdiff_t>(std::min(most, costs.size()));
  std::partial_sort(costs.begin(), end, costs.end());
  std::vector<std::size_t> numbers;
  for (auto at = costs.begin(); at != end; ++at) numbers.push_back(at->second);
  return numbers;
}

}  // namespace sculpt
