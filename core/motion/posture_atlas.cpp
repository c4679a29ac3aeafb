#include "core/motion/posture_atlas.hpp"

#include <algorithm>

#include "core/cell/ik.hpp"
#include "core/motion/random_configuration.hpp"
#include "core/motion/tool/tool_axes.hpp"

namespace sculpt {
namespace {

constexpr int parts_an_edge = 4;
constexpr int starts = 12;            ///< of IK, for a part and an axis
constexpr double same_posture = 0.2;  ///< rad or m: joints that differ by less are as good as the same

bool is_new(const std::vector<Configuration>& known, const Configuration& q) {
  return std::ranges::none_of(
      known, [&](const Configuration& other) { return (other - q).cwiseAbs().maxCoeff() < same_posture; });
}

}  // namespace

PostureAtlas::PostureAtlas(const Chain& chain, const Grid& grid, std::uint64_t seed)
    : chain_(chain),
      parts_{std::min(parts_an_edge, grid.n), grid.voxel_m * grid.n / std::min(parts_an_edge, grid.n), grid.origin_m},
      voxels_a_part_(grid.n / parts_.n),
      axes_(tool_axes()),
      seed_(seed),
      entries_(std::make_unique<Entry[]>(static_cast<std::size_t>(parts_.n * parts_.n * parts_.n) * axes_.size())) {}

Voxel PostureAtlas::part_of(Voxel voxel) const {
  return {voxel.i / voxels_a_part_, voxel.j / voxels_a_part_, voxel.k / voxels_a_part_};
}

const PostureAtlas::Postures& PostureAtlas::at(Voxel part, std::size_t axis) const {
  const int n = parts_.n;
  Entry& entry = entries_[static_cast<std::size_t>((part.k * n + part.j) * n + part.i) * axes_.size() + axis];
  std::call_once(entry.once, [&] { entry.postures = find(part, axis); });
  return entry.postures;
}

PostureAtlas::Postures PostureAtlas::find(Voxel part, std::size_t axis) const {
  const IkGoal goal{parts_.centre(part), axes_[axis]};
  const Configuration middle = (chain_.lower() + chain_.upper()) / 2;
  IkSettings unlimited;
  unlimited.respect_limits = false;
  const auto number = static_cast<std::uint64_t>((part.k * parts_.n + part.j) * parts_.n + part.i);
  Random random(mix(seed_, mix(number, axis)));
  Postures found;
  for (int start = 0; start < starts; ++start) {
    const Configuration from = start == 0 ? middle : random_configuration(chain_, random);
    if (auto q = solve_ik(chain_, goal, from)) {
      if (is_new(found.within, *q)) found.within.push_back(std::move(*q));
    } else if (found.within.empty() && found.beyond.empty()) {
      if (auto past = solve_ik(chain_, goal, from, unlimited)) found.beyond.push_back(std::move(*past));
    }
  }
  if (!found.within.empty()) found.beyond.clear();
  return found;
}

std::vector<Voxel> PostureAtlas::parts_by_distance(Voxel voxel) const {
  const Voxel own = part_of(voxel);
  std::vector<Voxel> parts;
  for (int k = std::max(0, own.k - 1); k <= std::min(parts_.n - 1, own.k + 1); ++k)
    for (int j = std::max(0, own.j - 1); j <= std::min(parts_.n - 1, own.j + 1); ++j)
      for (int i = std::max(0, own.i - 1); i <= std::min(parts_.n - 1, own.i + 1); ++i) parts.push_back({i, j, k});
  const Voxel twice = voxel * 2;
  const auto distance = [&](Voxel part) { return l1(twice, (part * 2 + Voxel{1, 1, 1}) * voxels_a_part_); };
  std::ranges::stable_sort(parts, {}, [&](Voxel part) { return part == own ? -1 : distance(part); });
  return parts;
}

std::vector<Configuration> PostureAtlas::around(Voxel voxel, std::size_t axis, std::size_t most) const {
  std::vector<Configuration> postures;
  for (const Voxel part : parts_by_distance(voxel)) {
    const std::vector<Configuration>& there = at(part, axis).within;
    const std::size_t more = std::min(most - postures.size(), there.size());
    postures.insert(postures.end(), there.begin(), there.begin() + static_cast<std::ptrdiff_t>(more));
    if (postures.size() == most) break;
  }
  return postures;
}

std::vector<Configuration> PostureAtlas::beyond_limits(Voxel voxel, std::size_t axis) const {
  std::vector<Configuration> postures;
  for (const Voxel part : parts_by_distance(voxel)) {
    const Postures& there = at(part, axis);
    postures.insert(postures.end(), there.beyond.begin(), there.beyond.end());
  }
  return postures;
}

}  // namespace sculpt
