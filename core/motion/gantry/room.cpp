#include "core/motion/gantry/room.hpp"

#include <algorithm>
#include <bit>

#include "core/cell/ik.hpp"
#include "core/collision/margins.hpp"

namespace sculpt {

Room::Room(const Scene& scene, const Configuration& seed, const Watch& watch) : seed_(seed) {
  const int edge = scene.grid().n + 2;
  look(scene, {-1, -1, 0}, static_cast<int>(std::bit_ceil(static_cast<unsigned>(edge))), watch);
  std::sort(closed_.begin(), closed_.end());
}

bool Room::is_open(Voxel position) const {
  return !std::binary_search(closed_.begin(), closed_.end(), position);
}

bool Room::look_again(const Scene& scene) {
  return std::erase_if(closed_, [&](Voxel position) { return is_free(scene, position); }) > 0;
}

bool Room::is_free(const Scene& scene, Voxel position) const {
  const auto q = solve_ik(scene.chain(), {scene.grid().centre(position), {}}, seed_);
  return q && scene.contact_at(*q, position) == Contact::none;
}

/// Surely at all positions from `low` to `high`, and between them? A prismatic chain's joint values are linear in the
/// ball's position, so those of the corners bound all.
bool Room::is_free(const Scene& scene, Voxel low, Voxel high) const {
  const Tool& tool = scene.tool();
  if (tool.shank_radius_m > 0) return false;  // it may touch material above
  JointBox box;
  for (int corner = 0; corner < 8; ++corner) {
    const Voxel at{corner & 1 ? high.i : low.i, corner & 2 ? high.j : low.j, corner & 4 ? high.k : low.k};
    const auto q = solve_ik(scene.chain(), {scene.grid().centre(at), {}}, seed_);
    if (!q) return false;
    box = corner == 0 ? JointBox{*q, *q} : JointBox{box.low.cwiseMin(*q), box.high.cwiseMax(*q)};
  }
  const Vec3 around = Vec3::Constant(tool.ball_radius_m + tool_margin_voxels * scene.grid().voxel_m);
  return scene.pairs_in(box).empty() &&
         scene.room_is_clear(scene.grid().centre(low) - around, scene.grid().centre(high) + around);
}

void Room::look(const Scene& scene, Voxel corner, int size, const Watch& watch) {
  const int n = scene.grid().n;
  const Voxel high{std::min(corner.i + size - 1, n), std::min(corner.j + size - 1, n),
                   std::min(corner.k + size - 1, n)};
  if (high.i < corner.i || high.j < corner.j || high.k < corner.k) return;
  if (watch.stop.stop_requested()) throw Cancelled{};
  if (size == 1) {
    if (!is_free(scene, corner)) closed_.push_back(corner);
    return;
  }
  if (is_free(scene, corner, high)) return;
  for (int part = 0; part < 8; ++part)
    look(scene, corner + Voxel{part & 1, part >> 1 & 1, part >> 2} * (size / 2), size / 2, watch);
}

}  // namespace sculpt
