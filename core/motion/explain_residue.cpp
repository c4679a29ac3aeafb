#include "core/motion/explain_residue.hpp"

#include <algorithm>
#include <bit>

#include "core/cell/ik.hpp"
#include "core/material/cavities.hpp"
#include "core/material/support/support.hpp"
#include "core/motion/behind.hpp"

namespace sculpt {
namespace {

constexpr std::size_t postures_an_axis = 8;

/// The farthest that a tool axis gets at this voxel, or that another one got.
Reason explain_axis(const Scene& scene, const ToolRoom& room, const PostureAtlas& atlas, Voxel voxel, std::size_t axis,
                    Reason farthest) {
  const IkGoal goal{scene.grid().centre(voxel), atlas.axes()[axis]};
  if (!room.is_free(scene.material(), voxel, *goal.axis)) return farthest;
  farthest = std::max(farthest, Reason::out_of_reach);
  const std::vector<Configuration> known = atlas.around(voxel, axis, postures_an_axis);
  for (const Configuration& start : known) {
    const auto q = solve_ik(scene.chain(), goal, start);
    if (q && scene.contact_at(*q, voxel) == Contact::none) return Reason::no_transit;
    if (q) farthest = std::max(farthest, Reason::link_collision);
  }
  if (farthest >= Reason::joint_limits) return farthest;
  IkSettings unlimited;
  unlimited.respect_limits = false;
  const auto is_beyond = [&](const Configuration& start) {
    return solve_ik(scene.chain(), goal, start, unlimited).has_value();
  };
  if (std::ranges::any_of(known, is_beyond) || std::ranges::any_of(atlas.beyond_limits(voxel, axis), is_beyond))
    return Reason::joint_limits;
  return Reason::out_of_reach;
}

/// Of a robot that only shifts its tool, and so comes to every voxel in one way.
Reason explain_shifted(const Scene& scene, const Support& support, Voxel voxel, const Configuration& middle) {
  const IkGoal goal{scene.grid().centre(voxel), {}};
  const auto q = solve_ik(scene.chain(), goal, middle);
  if (!q) {
    IkSettings beyond_limits;
    beyond_limits.respect_limits = false;
    return solve_ik(scene.chain(), goal, middle, beyond_limits) ? Reason::joint_limits : Reason::out_of_reach;
  }
  const Contact contact = scene.contact_at(*q, voxel);
  if (contact == Contact::tool_material) return Reason::tool_cannot_reach;
  if (contact != Contact::none) return Reason::link_collision;
  return support.frees(voxel) ? Reason::loose_piece : Reason::no_transit;
}

Reason explain(const Scene& scene, const Support& support, const ToolRoom& room, const PostureAtlas& atlas,
               Voxel voxel) {
  if (scene.chain().translating())
    return explain_shifted(scene, support, voxel, (scene.chain().lower() + scene.chain().upper()) / 2);
  Reason farthest = Reason::tool_cannot_reach;
  for (std::size_t axis = 0; axis < atlas.axes().size() && farthest < Reason::no_transit; ++axis)
    farthest = explain_axis(scene, room, atlas, voxel, axis, farthest);
  if (farthest == Reason::no_transit && support.frees(voxel)) return Reason::loose_piece;
  return farthest;
}

}  // namespace

std::vector<Residue> explain_residue(const Scene& scene, const PostureAtlas& atlas, const VoxelGrid& voxels,
                                     const VoxelSet& may_fall, const RunContext& run) {
  const VoxelSet enclosed = find_enclosed(voxels);
  const Support support(scene.material().solid(), may_fall);
  const ToolRoom room(scene);
  std::vector<Residue> residue;
  const auto n = static_cast<std::size_t>(voxels.n());
  for (std::size_t word = 0; word < voxels.stock.words().size(); ++word) {
    const std::uint64_t removable = voxels.stock.words()[word] & ~voxels.keep.words()[word];
    for (std::uint64_t left = scene.material().solid().words()[word] & removable; left != 0; left &= left - 1) {
      const std::size_t at = 64 * word + static_cast<std::size_t>(std::countr_zero(left));
      const Voxel v{static_cast<int>(at % n), static_cast<int>(at / n % n), static_cast<int>(at / n / n)};
      residue.push_back({v, Reason::enclosed});
    }
  }
  constexpr std::size_t at_once = 64;
  run.helpers.for_each_index((residue.size() + at_once - 1) / at_once, [&](std::size_t part) {
    for (std::size_t at = part * at_once; at < std::min((part + 1) * at_once, residue.size()); ++at) {
      if (run.watch.stop.stop_requested()) throw Cancelled{};
      auto& [voxel, reason] = residue[at];
      if (!enclosed.contains(voxel)) reason = explain(scene, support, room, atlas, voxel);
    }
  });
  find_behind(residue, scene, room, run.helpers, run.watch);
  return residue;
}

}  // namespace sculpt
