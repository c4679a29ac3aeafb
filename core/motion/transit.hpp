// Free motion from one configuration to another. The only door to OMPL.
#pragma once

#include <stop_token>
#include <vector>

#include "core/collision/scene.hpp"

namespace sculpt {

/// Budgets count steps, never seconds, so that the answer does not depend on the machine.
struct TransitSettings {
  int max_iterations = 2000;
  double range_rad = 0.7;  ///< longest tree edge, in the norm of the joint space
};

/// `path` is empty where no motion was found; `searched`: the direct edge was not free and RRTConnect was asked.
struct Transit {
  std::vector<Configuration> path;
  bool searched = false;
};

/// A path of certified edges from `from` to `to` (both rounded as they are stored, both included); empty if none was
/// found within the budget or a stop was asked for. The direct edge is tried first, then RRTConnect (Kuffner, LaValle
/// 2000), whose randomness comes from `seed` alone; superfluous keyframes are taken out again.
Transit plan_transit(const Scene& scene, const Configuration& from, const Configuration& to, std::uint64_t seed,
                     const std::stop_token& stop, const TransitSettings& settings = {});

/// Drops keyframes that a certified direct edge makes superfluous; the ends stay.
std::vector<Configuration> shorten(const Scene& scene, const std::vector<Configuration>& path);

}  // namespace sculpt
