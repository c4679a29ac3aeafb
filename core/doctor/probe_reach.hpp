// How far an arm comes in the stock: share of places that it can hold the tool at.
#pragma once

#include "core/base/run_context.hpp"
#include "core/collision/scene.hpp"
#include "core/doctor/findings.hpp"

namespace sculpt {

/// Share of 27 places all over the stock that are come to from `from`, one from the other, with the tool upright and
/// nothing but the tool in the full stock. An estimate that costs milliseconds. Any thread. Throws Cancelled.
double probe_reach(const Scene& scene, const Configuration& from, const Watch& watch);

/// For a quick look: voxels and places along an edge.
inline constexpr int coarse_resolution = 16, coarse_places = 3;

/// At how many of the corners and the middle of the stock's cube, over the straight directions, joints within limits
/// can hold the tool, found from `start` and a few random configurations; no contact is looked at. Any thread.
int count_joint_reach(const Cell& cell, const Configuration& start);

/// The straight directions, or for a robot that only shifts the one that it has, each over a lattice of `per_edge`^3
/// places; from `home` and random configurations. `field` stays 0. `scene` has the full stock standing. Deterministic
/// for a seed. Throws Cancelled.
struct Reach {
  std::vector<DirectionFinding> directions;
  double reached = 0;  ///< share of places that are free along some direction
};
Reach find_reach(const Scene& scene, const Configuration& home, int per_edge, const RunContext& run);

}  // namespace sculpt
