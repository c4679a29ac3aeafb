#include "core/place/turn_over.hpp"

#include <algorithm>
#include <numbers>

namespace sculpt {

std::vector<TurnOver> rate_turn_overs(const VoxelGrid& voxels, Access access, const ArmReach& reach,
                                      const RunContext& run) {
  std::vector<TurnOver> turns{{"half a turn about x", {180, 0, 0}, {}},
                              {"a quarter about x", {90, 0, 0}, {}},
                              {"a quarter back about x", {-90, 0, 0}, {}},
                              {"a quarter about y", {0, 90, 0}, {}},
                              {"a quarter back about y", {0, -90, 0}, {}}};
  run.helpers.for_each_index(turns.size(), [&](std::size_t at) {
    const CubeTurn turn = cube_turn(turns[at].rotate_deg * (std::numbers::pi / 180)).value();
    turns[at].share = find_share(find_demand(voxels, {no_turn, turn}, access, run), {&reach, &reach});
  });
  std::ranges::stable_sort(turns, [](const TurnOver& a, const TurnOver& b) { return a.share.held > b.share.held; });
  return turns;
}

}  // namespace sculpt
