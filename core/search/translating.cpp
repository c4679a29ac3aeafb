#include "core/search/translating.hpp"

#include <algorithm>
#include <limits>

#include "core/search/nearest_blocks.hpp"
#include "core/search/open_space.hpp"
#include "core/search/run_writer.hpp"

namespace sculpt {
namespace {

/// Corner `bits` (1: high x, 2: high y, 4: high z) of a block.
Voxel corner_of(const Block& block, int bits) {
  const int far = block.size - 1;
  return block.corner + Voxel{bits & 1 ? far : 0, bits & 2 ? far : 0, bits & 4 ? far : 0};
}

/// What is air only ever grows, and a block is carved whole, so which blocks can be reached is kept block by block:
/// a block that shares a face with reached air is a candidate until it is carved.
class Carving {
 public:
  Carving(const VoxelGrid& voxels, const Octree& octree, const BlockGraph& graph,
          const std::function<void(const VoxelRun&)>& emit)
      : octree_(octree),
        graph_(graph),
        space_(voxels.n()),
        candidates_(octree),
        seen_(octree.leaves.size()),
        writer_(translating_entry(voxels.n()), emit) {
    for (std::uint32_t id = 0; id < seen_.size(); ++id)
      if (on_the_outside(octree.leaves[id])) reach(id);
  }

  void run(const Watch& watch, std::uint64_t total) {
    std::uint64_t removed = 0;
    while (!candidates_.empty()) {
      watch.step(Stage::plan, removed, total);
      const std::uint32_t id = go_to_next();
      candidates_.erase(id);
      const Block& block = octree_.leaves[id];
      carve(block);
      removed += static_cast<std::uint64_t>(block.size) * block.size * block.size;
      for (std::uint32_t neighbour : graph_.of(static_cast<int>(id))) reach(neighbour);
    }
    travel(space_.find_way(writer_.at(), translating_entry(octree_.n)).value());
    writer_.finish();
    watch.step(Stage::plan, removed, total);
  }

 private:
  bool on_the_outside(const Block& block) const {
    const Voxel low = block.corner, high = corner_of(block, 7);
    return std::min(low.i, low.j) == 0 || std::max({high.i, high.j, high.k}) == octree_.n - 1;
  }

  /// `id` shares a face with reached air: air lets the robot further, a block to remove becomes a candidate.
  void reach(std::uint32_t id) {
    std::vector<std::uint32_t> waiting{id};
    while (!waiting.empty()) {
      const std::uint32_t next = waiting.back();
      waiting.pop_back();
      const Block& block = octree_.leaves[next];
      if (seen_[next] || block.label == Label::keep) continue;
      seen_[next] = true;
      if (block.label == Label::remove) {
        candidates_.insert(next);
        space_.want_cube(block.corner, block.size);
        continue;
      }
      space_.open_cube(block.corner, block.size);
      const auto neighbours = graph_.of(static_cast<int>(next));
      waiting.insert(waiting.end(), neighbours.begin(), neighbours.end());
    }
  }

  /// The open neighbour of `voxel` nearest to the robot, or where it stands if it is one.
  std::optional<Voxel> door_to(Voxel voxel) const {
    std::optional<Voxel> door;
    for (Voxel step : face_steps) {
      const Voxel beside = voxel + step;
      if (space_.is_open(beside) && (!door || l1(beside, writer_.at()) < l1(*door, writer_.at()))) door = beside;
    }
    return door;
  }

  struct Entry {
    Voxel voxel, door;
    int distance = std::numeric_limits<int>::max();
  };
  void consider(Voxel voxel, Entry& entry) const {
    const auto door = door_to(voxel);
    if (!door || l1(*door, writer_.at()) >= entry.distance) return;
    entry = {voxel, *door, l1(*door, writer_.at())};
  }

  /// A corner with an open face if there is one, else any voxel of the surface with one.
  Entry find_entry(const Block& block) const {
    Entry entry;
    for (int bits = 0; bits < 8; ++bits) consider(corner_of(block, bits), entry);
    if (entry.distance != std::numeric_limits<int>::max()) return entry;
    const int far = block.size - 1;
    for (int a = 0; a <= far; ++a)
      for (int b = 0; b <= far; ++b)
        for (Voxel on_face : {Voxel{0, a, b}, {far, a, b}, {a, 0, b}, {a, far, b}, {a, b, 0}, {a, b, far}})
          consider(block.corner + on_face, entry);
    return entry;
  }

  void travel(const std::vector<Voxel>& way) {
    for (Voxel corner : way) writer_.travel(corner);
  }

  /// Brings the robot into the first voxel of the block that is carved next. L1 does not see walls: where the best
  /// block is round a corner, the block with the shortest way is taken instead, so that both sides of a wall are not
  /// carved by turns.
  std::uint32_t go_to_next() {
    constexpr std::size_t search_limit =
        16;  // voxels; higher costs time and wins nothing (vase at 256: 2.6 s, 12 s with 1000)
    const std::uint32_t best = candidates_.best(writer_.at());
    const Entry entry = find_entry(octree_.leaves[best]);
    if (const auto way = space_.find_way(writer_.at(), entry.door, search_limit)) {
      travel(*way);
      step_to(entry.voxel);
      return best;
    }
    const OpenSpace::Wanted nearest = space_.find_wanted(writer_.at());
    travel(nearest.way);
    step_to(nearest.voxel);
    return static_cast<std::uint32_t>(octree_.find(nearest.voxel));
  }

  /// One step inside the block; what is cut already is only passed.
  void step_to(Voxel voxel) {
    if (space_.is_open(voxel)) return writer_.travel(voxel);
    writer_.cut(voxel);
    space_.open(voxel);
  }

  /// Straight to `to` inside the block, one axis after the other.
  void go_inside(Voxel to) {
    for (int axis = 0; axis < 3; ++axis) {
      for (;;) {
        const Voxel way = to - writer_.at();
        const int left = axis == 0 ? way.i : axis == 1 ? way.j : way.k;
        if (left == 0) break;
        step_to(writer_.at() + face_steps[2 * axis + (left > 0 ? 1 : 0)]);
      }
    }
  }

  /// Row by row, layer by layer, from the corner where the robot stands.
  void sweep(const Block& block, int row_axis, int line_axis, int layer_axis) {
    std::array<Voxel, 3> step{};
    const Voxel in = writer_.at() - block.corner;
    const std::array<int, 3> at{in.i, in.j, in.k};
    for (int axis = 0; axis < 3; ++axis) step[axis] = face_steps[2 * axis + (at[axis] == 0 ? 1 : 0)];
    for (int layer = 0; layer < block.size; ++layer) {
      if (layer > 0) step_to(writer_.at() + step[layer_axis]);
      for (int line = 0; line < block.size; ++line) {
        if (line > 0) step_to(writer_.at() + step[line_axis]);
        for (int cell = 1; cell < block.size; ++cell) step_to(writer_.at() + step[row_axis]);
        step[row_axis] = step[row_axis] * -1;
      }
      step[line_axis] = step[line_axis] * -1;
    }
  }

  /// From the voxel where the robot entered.
  void carve(const Block& block) {
    int nearest = 0;
    for (int bits = 1; bits < 8; ++bits)
      if (l1(corner_of(block, bits), writer_.at()) < l1(corner_of(block, nearest), writer_.at())) nearest = bits;
    go_inside(corner_of(block, nearest));
    sweep(block, 0, 1, 2);
  }

  const Octree& octree_;
  const BlockGraph& graph_;
  OpenSpace space_;
  NearestBlocks candidates_;
  std::vector<bool> seen_;
  RunWriter writer_;
};

}  // namespace

void carve_translating(const VoxelGrid& voxels, const Octree& octree, const BlockGraph& graph,
                       const std::function<void(const VoxelRun&)>& emit, const Watch& watch) {
  std::uint64_t total = 0;
  for (const Block& block : octree.leaves)
    if (block.label == Label::remove) total += static_cast<std::uint64_t>(block.size) * block.size * block.size;
  Carving(voxels, octree, graph, emit).run(watch, total);
}

}  // namespace sculpt
