#include "core/place/demand.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace sculpt {
namespace {

/// The best that any of the directions gives, and those that hold.
std::pair<Hold, ViewSet> best_hold(const Asked& asked, const ArmReach& reach) {
  Hold best = Hold::reach;
  ViewSet held = 0;
  for (std::size_t view = 0; view < all_views; ++view) {
    if (!(asked.views >> view & 1)) continue;
    const Hold hold = reach.holds[view][asked.sector];
    best = std::min(best, hold);
    if (hold == Hold::held) held |= ViewSet{1} << view;
  }
  return {best, held};
}

void add(Share& share, Hold hold, std::uint64_t voxels) {
  switch (hold) {
    case Hold::held:
      share.held += voxels;
      break;
    case Hold::stock:
      share.stock += voxels;
      break;
    case Hold::links:
      share.links += voxels;
      break;
    case Hold::limits:
      share.limits += voxels;
      break;
    case Hold::reach:
      share.reach += voxels;
      break;
  }
}

}  // namespace

Demand find_demand(const VoxelGrid& voxels, const std::vector<CubeTurn>& clampings, Access access,
                   const RunContext& run) {
  const int n = voxels.n();
  std::vector<ViewSets> views;
  for (const CubeTurn& clamping : clampings)
    views.push_back(find_views({clamping.of(voxels.stock), clamping.of(voxels.keep), {}}, access, run));
  VoxelSet removable = voxels.stock;
  removable -= voxels.keep;
  std::map<std::vector<Asked>, std::uint64_t> counts;
  Demand demand;
  for_each_voxel(removable, [&](Voxel v) {
    std::vector<Asked> asked;
    for (std::size_t at = 0; at < clampings.size(); ++at) {
      const Voxel there = clampings[at].of(v, n);
      asked.push_back({static_cast<std::uint16_t>(sector_index(sector_of(Vec3(there.i, there.j, there.k), n))),
                       views[at][voxels.keep.index(there)]});
    }
    ++counts[std::move(asked)];
    ++demand.removable;
  });
  for (auto& [asked, count] : counts) demand.wants.push_back({asked, count});
  return demand;
}

Share find_share(const Demand& demand, const std::vector<const ArmReach*>& reaches) {
  Share share;
  share.removable = demand.removable;
  for (const Want& want : demand.wants) {
    Hold best = Hold::reach;
    ViewSet any = 0, held = 0;
    for (std::size_t at = 0; at < reaches.size(); ++at) {
      any |= want.clampings[at].views;
      const auto [hold, along] = best_hold(want.clampings[at], *reaches[at]);
      if (want.clampings[at].views != 0) best = std::min(best, hold);
      held |= along;
    }
    if (any == 0) {
      share.tool += want.voxels;
      continue;
    }
    add(share, best, want.voxels);
    for (std::size_t view = 0; view < all_views; ++view)
      if (held >> view & 1) share.held_along[view] += want.voxels;
  }
  return share;
}

}  // namespace sculpt
