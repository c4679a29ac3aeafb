// A target -> what is asked of an arm that is to carve it: which sectors must be held along which directions.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/run_context.hpp"
#include "core/material/cube_turn.hpp"
#include "core/material/voxel_grid.hpp"
#include "core/place/arm/arm_reach.hpp"
#include "core/place/tool_room_views.hpp"

namespace sculpt {

/// Voxels that one clamping asks for in the same way: those of a sector for which ball and shank alone, with all gone
/// that is to be removed, have room along these directions and no other.
struct Asked {
  std::uint16_t sector = 0;
  ViewSet views = 0;
  auto operator<=>(const Asked&) const = default;
};

/// Voxels that are asked for in the same way in every clamping.
struct Want {
  std::vector<Asked> clampings;
  std::uint64_t voxels = 0;
};

struct Demand {
  std::vector<Want> wants;      ///< in the order of what they ask
  std::uint64_t removable = 0;  ///< voxels, all that is not to be kept of the stock
};

/// `clampings`: how the block is turned in each of them, one at least; the grid turns onto itself. Throws Cancelled.
Demand find_demand(const VoxelGrid& voxels, const std::vector<CubeTurn>& clampings, Access access,
                   const RunContext& run);

/// What a stand makes of a demand, in voxels. Every removable voxel is in one of these.
struct Share {
  std::uint64_t removable = 0;
  std::uint64_t held = 0;
  std::uint64_t tool = 0;                                     ///< the tool alone has no room along any direction
  std::uint64_t stock = 0, links = 0, limits = 0, reach = 0;  ///< the nearest miss (Hold)
  /// Of those that are held, along each direction (one voxel in several).
  std::array<std::uint64_t, all_views> held_along{};

  double of_removable() const {
    return removable == 0 ? 1 : static_cast<double>(held) / static_cast<double>(removable);
  }
};

/// `reaches`: one for each clamping of the demand.
Share find_share(const Demand& demand, const std::vector<const ArmReach*>& reaches);

}  // namespace sculpt
