#include "core/material/support/support_search.hpp"

#include <algorithm>

#include "core/material/voxel.hpp"

namespace sculpt {
namespace {

/// Voxels and cubes that a search looks at before the whole grid is flooded, a row of words at a time: as many as cost
/// about as much as that.
constexpr std::size_t fewest_looked_at = 8192, voxels_flooded_for_one = 16384;
constexpr int cube_edge = 8;

}  // namespace

SupportSearch::SupportSearch(const VoxelSet& standing, const VoxelSet& may_fall,
                             const std::function<int(int, int)>& rooted, Voxel gone, Scratch& scratch)
    : standing_(standing),
      may_fall_(may_fall),
      rooted_(rooted),
      gone_(gone),
      edge_(std::min(cube_edge, standing.n())),
      max_looked_at_(std::max(fewest_looked_at, 64 * standing.words().size() / voxels_flooded_for_one)),
      scratch_(scratch) {
  scratch_.whole.clear();
}

void SupportSearch::open(const Node& node) {
  scratch_.open.push_back(node);
  std::push_heap(scratch_.open.begin(), scratch_.open.end());
}

SupportSearch::Way SupportSearch::follow(Voxel from, std::vector<Voxel>& others, bool any_held) {
  scratch_.seen.clear();
  scratch_.seen_cubes.clear();
  scratch_.open.clear();
  others_ = &others;
  any_held_ = any_held;
  foreseen_ = true;
  if (consider(from) == Found::held) return Way::held;
  while (!scratch_.open.empty()) {
    std::pop_heap(scratch_.open.begin(), scratch_.open.end());
    const Node node = scratch_.open.back();
    scratch_.open.pop_back();
    if (look_around(node) == Found::held) return Way::held;
    if (scratch_.seen.size() + scratch_.seen_cubes.size() > max_looked_at_) return Way::long_;
  }
  return foreseen_ ? Way::falls : Way::none;
}

SupportSearch::Found SupportSearch::look_around(const Node& node) {
  if (!node.whole) {
    for (const Voxel step : face_steps)
      if (consider(node.corner + step) == Found::held) return Found::held;
    return Found::nothing;
  }
  for (const Voxel step : face_steps) {
    const Voxel beside = node.corner + step * edge_;
    const auto in = [&](int x) { return x >= 0 && x < standing_.n(); };
    if (!in(beside.i) || !in(beside.j) || !in(beside.k)) continue;
    if (is_whole(beside)) {
      if (enter_cube(beside) == Found::held) return Found::held;
      continue;
    }
    const Voxel across{step.i == 0, step.j == 0, step.k == 0};
    const Voxel first =
        node.corner + Voxel{step.i > 0, step.j > 0, step.k > 0} * edge_ - Voxel{step.i < 0, step.j < 0, step.k < 0};
    const auto last = [&](int along) { return along != 0 ? edge_ : 1; };
    for (int k = 0; k < last(across.k); ++k)
      for (int j = 0; j < last(across.j); ++j)
        for (int i = 0; i < last(across.i); ++i)
          if (consider(first + Voxel{i, j, k}) == Found::held) return Found::held;
  }
  return Found::nothing;
}

SupportSearch::Found SupportSearch::consider(Voxel voxel) {
  const Grid bounds{standing_.n(), 1, Vec3::Zero()};
  if (!bounds.contains(voxel) || voxel == gone_ || !standing_.contains(voxel)) return Found::nothing;
  if (const Voxel cube = cube_of(voxel); is_whole(cube)) return enter_cube(cube);
  if (!scratch_.seen.enter(standing_.index(voxel)).second) return Found::nothing;
  if (is_rooted(voxel)) return Found::held;
  if (std::erase(*others_, voxel) > 0 && joins_all()) return Found::held;
  foreseen_ = foreseen_ && may_fall_.contains(voxel);
  open({voxel, false});
  return Found::nothing;
}

SupportSearch::Found SupportSearch::enter_cube(Voxel corner) {
  if (!scratch_.seen_cubes.enter(standing_.index(corner)).second) return Found::nothing;
  for (int j = 0; j < edge_; ++j)
    for (int i = 0; i < edge_; ++i)
      if (is_rooted(corner + Voxel{i, j, 0})) return Found::held;
  if (std::erase_if(*others_, [&](Voxel other) { return cube_of(other) == corner; }) > 0 && joins_all())
    return Found::held;
  foreseen_ = foreseen_ && has_all(may_fall_, corner);
  open({corner, true});
  return Found::nothing;
}

/// Does a column that stands on the table hold this voxel, once `gone_` is gone?
bool SupportSearch::is_rooted(Voxel voxel) const {
  const int height = rooted_(voxel.i, voxel.j);
  return voxel.k < (voxel.i == gone_.i && voxel.j == gone_.j ? std::min(height, gone_.k) : height);
}

bool SupportSearch::is_whole(Voxel corner) {
  const auto [whole, is_new] = scratch_.whole.enter(standing_.index(corner));
  if (is_new) whole = cube_of(gone_) != corner && has_all(standing_, corner);
  return whole != 0;
}

bool SupportSearch::has_all(const VoxelSet& set, Voxel corner) const {
  const std::uint64_t row = (std::uint64_t{1} << edge_) - 1;
  for (int k = 0; k < edge_; ++k)
    for (int j = 0; j < edge_; ++j) {
      const std::size_t at = set.index(corner + Voxel{0, j, k});
      if ((set.words()[at >> 6] >> (at & 63) & row) != row) return false;
    }
  return true;
}

}  // namespace sculpt
