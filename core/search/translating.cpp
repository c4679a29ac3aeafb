#include "core/search/translating.hpp"

#include <algorithm>
#include <limits>

#include "core/search/nearest_blocks.hpp"
#include "core/search/run_writer.hpp"
#include "core/search/voxel_space.hpp"

namespace sculpt {
namespace {

/// Which of the two ends of a block, along one axis, is nearer.
int nearer_end(int at, int low, int size) {
  return at - low < low + size - 1 - at ? low : low + size - 1;
}

Voxel nearest_corner(const Block& block, Voxel from) {
  return {nearer_end(from.i, block.corner.i, block.size), nearer_end(from.j, block.corner.j, block.size),
          nearer_end(from.k, block.corner.k, block.size)};
}

std::uint64_t volume(const Block& block) {
  return static_cast<std::uint64_t>(block.size) * block.size * block.size;
}

/// What is air only ever grows, and a block is carved whole, so which blocks can be reached is kept block by block:
/// a block that shares a face with reached air is a candidate until it is carved.
class Carving {
 public:
  Carving(const VoxelGrid& voxels, const Octree& octree, const BlockGraph& graph,
          const std::function<void(const VoxelRun&)>& emit)
      : octree_(octree),
        graph_(graph),
        space_(voxels),
        candidates_(voxels.n()),
        seen_(octree.leaves.size()),
        writer_(translating_entry(voxels.n()), emit) {
    for (std::uint32_t id = 0; id < seen_.size(); ++id)
      if (on_the_outside(octree.leaves[id])) reach(id);
  }

  void run(const Watch& watch) {
    std::uint64_t removed = 0, total = 0;
    for (const Block& block : octree_.leaves)
      if (block.label == Label::remove) total += volume(block);
    while (!candidates_.empty()) {
      watch.step(Stage::plan, removed, total);
      const Block block = enter_next();
      candidates_.erase(block);
      carve(block);
      removed += volume(block);
      for (std::uint32_t neighbour : graph_.of(octree_.find(block.corner))) reach(neighbour);
    }
    const Voxel home = translating_entry(octree_.n);
    travel(space_.find_way(space_.index(writer_.at()), 0, [home](Voxel from, int) { return l1(from, home); }).value());
    writer_.finish();
    watch.step(Stage::plan, removed, total);
  }

 private:
  using Way = std::vector<std::uint8_t>;

  bool on_the_outside(const Block& block) const {
    const Voxel low = block.corner, high = low + Voxel{1, 1, 1} * (block.size - 1);
    return std::min(low.i, low.j) == 0 || std::max({high.i, high.j, high.k}) == octree_.n - 1;
  }

  /// `id` shares a face with reached air: air lets the robot further, a block to remove becomes a candidate.
  void reach(std::uint32_t id) {
    waiting_.assign(1, id);
    while (!waiting_.empty()) {
      const std::uint32_t next = waiting_.back();
      waiting_.pop_back();
      const Block& block = octree_.leaves[next];
      if (seen_[next] || block.label == Label::keep) continue;
      seen_[next] = true;
      if (block.label == Label::remove) {
        candidates_.insert(block);
        continue;
      }
      const auto neighbours = graph_.of(static_cast<int>(next));
      waiting_.insert(waiting_.end(), neighbours.begin(), neighbours.end());
    }
  }

  /// A corner of a block and the air beside it.
  struct Entry {
    Voxel corner, door;
  };
  std::optional<Entry> nearest_entry(const Block& block) const {
    std::optional<Entry> nearest;
    const int far = block.size - 1;
    for (int bits = 0; bits < (far > 0 ? 8 : 1); ++bits) {
      const Voxel corner = block.corner + Voxel{bits & 1, bits >> 1 & 1, bits >> 2} * far;
      for (Voxel step : face_steps) {
        const Voxel door = corner + step;
        if (nearest && l1(door, writer_.at()) >= l1(nearest->door, writer_.at())) continue;
        if (space_.is_air(space_.index(door))) nearest = {corner, door};
      }
    }
    return nearest;
  }

  /// Where the robot turns on a way to `target` that goes along each axis once, if one of those is free.
  std::optional<std::array<Voxel, 3>> straight_way(Voxel target) const {
    // Up first and down last, sideways between: that is free most often.
    constexpr int orders[6][3] = {{2, 0, 1}, {2, 1, 0}, {0, 1, 2}, {1, 0, 2}, {0, 2, 1}, {1, 2, 0}};
    for (const auto& order : orders) {
      std::array<Voxel, 3> turns;
      Voxel at = writer_.at();
      for (int leg = 0; leg < 3; ++leg) turns[leg] = at = follow(at, target, order[leg]);
      if (at == target) return turns;
    }
    return std::nullopt;
  }

  /// Along one axis towards `target`, as far as there is air.
  Voxel follow(Voxel at, Voxel target, int axis) const {
    const int way = axis == 0 ? target.i - at.i : axis == 1 ? target.j - at.j : target.k - at.k;
    const Voxel step = face_steps[2 * axis + (way > 0 ? 1 : 0)];
    for (int left = std::abs(way); left > 0 && space_.is_air(space_.index(at + step)); --left) at = at + step;
    return at;
  }

  void travel(const Way& way) {
    for (int face : way) writer_.travel(writer_.at() + face_steps[face]);
  }

  /// Brings the robot into the first voxel of the block that is carved next: a corner of the best one, for there its
  /// boustrophedon begins. L1 does not see walls: where no straight way leads to that corner, the block with the
  /// shortest way is taken instead, so that both sides of a wall are not carved by turns.
  Block enter_next() {
    const Block best = candidates_.best(writer_.at());
    if (const auto entry = nearest_entry(best)) {
      if (const auto turns = straight_way(entry->door)) {
        for (Voxel turn : *turns) writer_.travel(turn);
        cut(entry->corner);
        return best;
      }
    }
    travel(way_to_nearest());
    const VoxelSpace::Index at = space_.index(writer_.at());
    int face = 0;
    while (!space_.is_remove(space_.beside(at, face))) ++face;
    const Voxel voxel = writer_.at() + face_steps[face];
    cut(voxel);
    return octree_.leaves[static_cast<std::size_t>(octree_.find(voxel))];
  }

  Way way_to_nearest() {
    Block block = *candidates_.nearest(writer_.at(), std::numeric_limits<int>::max());
    const auto distance = [&](Voxel from, int most) {
      // Towards the block that was nearest one step before, nothing else can be nearer.
      if (block.distance(from) > most - 2) block = candidates_.nearest(from, most).value_or(block);
      return std::min(block.distance(from), most);
    };
    return space_.find_way(space_.index(writer_.at()), 1, distance).value();
  }

  void cut(Voxel voxel) {
    writer_.cut(voxel, voxel);
    space_.open(space_.index(voxel));
  }

  /// One step inside the block; what is cut already is only passed.
  void step_to(Voxel voxel) {
    if (space_.is_air(space_.index(voxel)))
      writer_.travel(voxel);
    else
      cut(voxel);
  }

  /// Straight to `to` inside the block, one axis after the other.
  void go_inside(Voxel to) {
    for (int face = 0; face < 6; ++face)
      while (l1(writer_.at() + face_steps[face], to) < l1(writer_.at(), to)) step_to(writer_.at() + face_steps[face]);
  }

  /// From the voxel where the robot entered: to a corner, then row by row, layer by layer.
  void carve(const Block& block) {
    const Voxel entered = writer_.at(), corner = nearest_corner(block, entered);
    go_inside(corner);
    const bool whole = entered == corner;  // but for the corner itself
    const Voxel in = corner - block.corner;
    Voxel along{in.i == 0 ? 1 : -1, 0, 0}, aside{0, in.j == 0 ? 1 : -1, 0};
    const Voxel deeper{0, 0, in.k == 0 ? 1 : -1};
    for (int layer = 0; layer < block.size; ++layer) {
      if (layer > 0) step_to(writer_.at() + deeper);
      for (int row = 0; row < block.size; ++row) {
        if (row > 0) step_to(writer_.at() + aside);
        go_along(along, block.size - 1, whole);
        along = along * -1;
      }
      aside = aside * -1;
    }
    space_.open_cube(block.corner, block.size);
  }

  /// `whole`: nothing of these `count` voxels is cut yet. They are opened by the caller then.
  void go_along(Voxel step, int count, bool whole) {
    if (whole && count > 0) return writer_.cut(writer_.at() + step, writer_.at() + step * count);
    for (int cell = 0; cell < count; ++cell) step_to(writer_.at() + step);
  }

  const Octree& octree_;
  const BlockGraph& graph_;
  VoxelSpace space_;
  NearestBlocks candidates_;
  std::vector<bool> seen_;
  std::vector<std::uint32_t> waiting_;  ///< scratch of `reach`
  RunWriter writer_;
};

}  // namespace

void carve_translating(const VoxelGrid& voxels, const Octree& octree, const BlockGraph& graph,
                       const std::function<void(const VoxelRun&)>& emit, const Watch& watch) {
  Carving(voxels, octree, graph, emit).run(watch);
}

}  // namespace sculpt
