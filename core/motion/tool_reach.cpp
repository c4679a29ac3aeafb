#include "core/motion/tool_reach.hpp"

#include <algorithm>

#include "core/base/parallel.hpp"
#include "core/motion/tool_axes.hpp"

namespace sculpt {
namespace {

constexpr double margin = 0.005;  // voxel edges, as in Scene

std::vector<Voxel> voxels_of(const VoxelSet& set) {
  std::vector<Voxel> voxels;
  for (int k = 0; k < set.n(); ++k)
    for (int j = 0; j < set.n(); ++j)
      for (int i = 0; i < set.n(); ++i)
        if (set.contains({i, j, k})) voxels.push_back({i, j, k});
  return voxels;
}

bool has_open_face(const Material& material, Voxel v) {
  return std::any_of(face_steps.begin(), face_steps.end(),
                     [&](Voxel step) { return (v + step).k >= 0 && !material.contains(v + step); });
}

}  // namespace

VoxelSet find_out_of_tool_reach(const Scene& scene, const VoxelSet& keep, int threads, const Watch& watch) {
  Material material(scene.material().solid());
  VoxelSet left = material.solid();
  for (std::size_t w = 0; w < left.words().size(); ++w) left.words()[w] &= ~keep.words()[w];
  std::vector<Voxel> waiting = voxels_of(left);

  const std::vector<Vec3> axes = tool_axes();
  const double h = scene.grid().voxel_m, length = scene.tool().stickout_m / h;
  const double radius = std::max(scene.tool().ball_radius_m, scene.tool().shank_radius_m) / h + margin;
  const auto fits = [&](Voxel v) {
    if (watch.stop.stop_requested()) throw Cancelled{};
    const Vec3 ball(v.i + 0.5, v.j + 0.5, v.k + 0.5);
    return has_open_face(material, v) && std::any_of(axes.begin(), axes.end(), [&](const Vec3& axis) {
             return !material.meets_capsule({ball, ball + length * axis}, radius, v);
           });
  };
  std::vector<char> fitting;
  do {
    fitting.assign(waiting.size(), 0);
    for_each_index(threads, waiting.size(), [&](std::size_t at) { fitting[at] = fits(waiting[at]); });
    std::vector<Voxel> still;
    for (std::size_t at = 0; at < waiting.size(); ++at) {
      if (!fitting[at]) {
        still.push_back(waiting[at]);
        continue;
      }
      material.remove(waiting[at]);
      left.erase(waiting[at]);
    }
    waiting.swap(still);
  } while (std::find(fitting.begin(), fitting.end(), 1) != fitting.end());
  return left;
}

}  // namespace sculpt
