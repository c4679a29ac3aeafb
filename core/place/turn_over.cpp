#include "core/place/turn_over.hpp"

#include <algorithm>

namespace sculpt {

std::vector<TurnOver> rate_turn_overs(const VoxelGrid& voxels, Access access, const ArmReach& reach,
                                      const RunContext& run) {
  const Voxel x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  std::vector<TurnOver> turns{{"half a turn about x", {180, 0, 0}, {{x, y * -1, z * -1}}, {}},
                              {"a quarter about x", {90, 0, 0}, {{x, z, y * -1}}, {}},
                              {"a quarter back about x", {-90, 0, 0}, {{x, z * -1, y}}, {}},
                              {"a quarter about y", {0, 90, 0}, {{z * -1, y, x}}, {}},
                              {"a quarter back about y", {0, -90, 0}, {{z, y, x * -1}}, {}}};
  run.helpers.for_each_index(turns.size(), [&](std::size_t at) {
    turns[at].share = find_share(find_demand(voxels, {no_turn, turns[at].turn}, access, run), {&reach, &reach});
  });
  std::ranges::stable_sort(turns, [](const TurnOver& a, const TurnOver& b) { return a.share.held > b.share.held; });
  return turns;
}

}  // namespace sculpt
