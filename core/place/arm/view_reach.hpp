// One direction of one stand: from seeds over all sectors. Internal to place/.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/place/arm/hold.hpp"
#include "core/place/arm/posture_seeds.hpp"
#include "core/place/arm/sectors.hpp"
#include "core/place/arm/stand_contacts.hpp"
#include "core/sweep/field/posture_lanes.hpp"

namespace sculpt {

/// The cell as it stands, as the directions of one stand share it. What it refers to must outlive it.
struct StandArm {
  const Chain& chain;
  const Chain& free_chain;  ///< the same without joint limits
  const Grid& grid;
  const StandContacts& contacts;
  const Body& block;
  const PostureSeeds& seeds;
  const SeedPoses& seed_poses;
};

/// Holds by sector of the view; what can be known besides.
struct ViewReach {
  std::array<Hold, all_sectors> holds;
  std::optional<Configuration> above;  ///< free, over the middle of the grid; of straight directions only
  Configuration low, high;             ///< around the configurations of the branch that holds most; empty if none
};

ViewReach find_view_reach(const StandArm& arm, const ToolView& view);

}  // namespace sculpt
