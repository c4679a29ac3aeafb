#include "core/search/translating.hpp"

#include <algorithm>
#include <limits>

#include "core/search/boustrophedon.hpp"
#include "core/search/nearest_blocks.hpp"
#include "core/search/voxel_search.hpp"
#include "core/search/voxel_space.hpp"

namespace sculpt {
namespace {

/// Ways to blocks that then cannot go whole, one after the other, after which blocks are given up for now.
constexpr int max_in_vain = 32;

std::uint64_t volume(const Block& block) {
  return static_cast<std::uint64_t>(block.size) * block.size * block.size;
}

/// What is air only ever grows, and a block is carved whole, so which blocks can be reached is kept block by block:
/// a block that shares a face with reached air is a candidate until it is carved.
class Carving {
 public:
  Carving(const VoxelGrid& voxels, const Octree& octree, const BlockGraph& graph, const Ground& ground,
          const std::function<void(const VoxelRun&)>& emit)
      : voxels_(voxels),
        octree_(octree),
        graph_(graph),
        ground_(ground),
        space_(voxels),
        candidates_(voxels.n()),
        seen_(octree.leaves.size()),
        writer_(ground.start, emit) {
    for (const Voxel position : ground.closed) space_.close(position);
    for (const auto& [from, to] : ground.blocked) space_.block(from, to);
    if (ground.support != nullptr) support_.emplace(*ground.support);
    for (std::uint32_t id = 0; id < seen_.size(); ++id)
      if (on_the_outside(octree.leaves[id])) reach(id);
  }

  void run(const Watch& watch) {
    std::uint64_t removed = 0, total = 0;
    for (const Block& block : octree_.leaves)
      if (block.label == Label::remove) total += volume(block);
    for (std::size_t tried_again_at = 0;;) {
      watch.step(Stage::plan, removed, total);
      if (const auto approach = next_approach()) {
        travel(approach->way);
        cut(approach->entry);
        candidates_.erase(approach->block);
        carve(approach->block);
        removed += volume(approach->block);
        carved_.push_back(approach->block);
        for (std::uint32_t neighbour : graph_.of(octree_.find(approach->block.corner))) reach(neighbour);
      } else if (carved_.size() - tried_again_at <= aside_.size() / 4) {
        break;
      } else {
        tried_again_at = carved_.size();
        for (const Block& block : aside_) candidates_.insert(block);
        aside_.clear();
      }
    }
    if (!aside_.empty() || !candidates_.empty()) return carve_rest(watch);
    const Voxel end = ground_.end;
    travel(space_.find_way(space_.index(writer_.at()), 0, [end](Voxel from, int) { return l1(from, end); }).value());
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
    const int face = 2 * axis + (way > 0 ? 1 : 0);
    for (int left = std::abs(way); left > 0 && space_.is_air(space_.index(at + step)); --left) {
      if (space_.is_blocked(space_.index(at), face)) break;
      at = at + step;
    }
    return at;
  }

  void travel(const Way& way) {
    for (int face : way) writer_.travel(writer_.at() + face_steps[face]);
  }
  void travel(const std::vector<Voxel>& way) {
    for (Voxel turn : way) writer_.travel(turn);
  }

  /// The block that is carved next, the voxel of it that is cut first, and the way to beside that.
  struct Approach {
    Block block;
    Voxel entry;
    std::vector<Voxel> way;  ///< where it turns, or step by step
  };

  /// To a block that can go whole; those that cannot are set aside. Nothing if there is no way to any, or too many were
  /// looked for in vain.
  std::optional<Approach> next_approach() {
    for (int in_vain = 0; !candidates_.empty() && in_vain < max_in_vain;) {
      auto approach = straight_approach();
      if (!approach) {
        approach = nearest_approach();
        ++in_vain;
      }
      if (!approach || can_go_whole(approach->block, approach->entry)) return approach;
      candidates_.erase(approach->block);
      aside_.push_back(approach->block);
    }
    return std::nullopt;
  }

  /// To a corner of the best block, for there its boustrophedon begins.
  std::optional<Approach> straight_approach() const {
    const Block best = candidates_.best(writer_.at());
    const auto entry = nearest_entry(best);
    if (!entry) return std::nullopt;
    const auto turns = straight_way(entry->door);
    if (!turns) return std::nullopt;
    return Approach{best, entry->corner, {turns->begin(), turns->end()}};
  }

  /// L1 does not see walls: where no straight way leads to that corner, the block with the shortest way is taken
  /// instead, so that both sides of a wall are not carved by turns.
  std::optional<Approach> nearest_approach() {
    const auto way = way_to_nearest();
    if (!way) return std::nullopt;
    Approach approach{{}, writer_.at(), {}};
    for (int face : *way) approach.way.push_back(approach.entry = approach.entry + face_steps[face]);
    const VoxelSpace::Index at = space_.index(approach.entry);
    int face = 0;
    while (!is_candidate(space_.voxel(space_.beside(at, face)))) ++face;
    approach.entry = approach.entry + face_steps[face];
    approach.block = octree_.leaves[static_cast<std::size_t>(octree_.find(approach.entry))];
    return approach;
  }

  bool is_candidate(Voxel voxel) const {
    const Grid bounds{octree_.n, 1, Vec3::Zero()};
    return bounds.contains(voxel) && space_.is_remove(space_.index(voxel)) &&
           candidates_.contains(octree_.leaves[static_cast<std::size_t>(octree_.find(voxel))]);
  }

  std::optional<Way> way_to_nearest() {
    Block block = *candidates_.nearest(writer_.at(), std::numeric_limits<int>::max());
    const auto distance = [&](Voxel from, int most) {
      const int known = std::min(most, block.distance(from));
      if (known <= most - 2) return known;  // nothing can be nearer than one step less than at the voxel before
      const auto nearer = candidates_.nearest(from, known);
      if (!nearer) return known;
      block = *nearer;
      return block.distance(from);
    };
    return space_.find_way(space_.index(writer_.at()), 1, distance);
  }

  /// Is no step in it blocked, and does none of its voxels hold what would come free? Then it counts as gone.
  bool can_go_whole(const Block& block, Voxel entered) {
    const auto in_block = [&](const auto& step) { return block.contains(step.first) || block.contains(step.second); };
    if (std::any_of(ground_.blocked.begin(), ground_.blocked.end(), in_block)) return false;
    if (!support_) return true;
    std::vector<VoxelLine> gone;
    const auto take = [&](const VoxelLine& line) {
      const int count = support_->remove(line), all = l1(line.first, line.last) + 1;
      if (count > 0) gone.push_back({line.first, line.first + sign(line.last - line.first) * (count - 1)});
      return count == all;
    };
    bool all = take({entered, entered});
    const bool whole = entered == nearest_corner(block, entered);
    walk_rows(block, entered, [&](Voxel from, Voxel to) {
      const Voxel step = sign(to - from);
      if (whole) {
        all = all && take({from + step, to});
        return;
      }
      for (Voxel at = from; all && at != to;) {
        at = at + step;
        if (support_->standing().contains(at)) all = take({at, at});
      }
    });
    for (std::size_t at = all ? 0 : gone.size(); at-- > 0;) support_->restore(gone[at]);
    return all;
  }

  void cut(Voxel voxel) {
    writer_.cut(voxel, voxel);
    space_.open(space_.index(voxel));
  }

  /// One step inside the block; what is cut already is only passed.
  void step_to(Voxel voxel) { space_.is_air(space_.index(voxel)) ? writer_.travel(voxel) : cut(voxel); }

  void carve(const Block& block) {
    const bool whole = writer_.at() == nearest_corner(block, writer_.at());  // nothing but the corner is cut yet
    walk_rows(block, writer_.at(), [&](Voxel from, Voxel to) {
      const Voxel step = sign(to - from);
      if (whole) return writer_.cut(from + step, to);
      while (writer_.at() != to) step_to(writer_.at() + step);
    });
    space_.open_cube(block.corner, block.size);
  }

  /// What no block can go of, voxel by voxel.
  void carve_rest(const Watch& watch) {
    VoxelGrid rest{voxels_.stock, voxels_.keep};
    for (const Block& block : carved_)
      for (int k = 0; k < block.size; ++k)
        for (int j = 0; j < block.size; ++j) {
          const Voxel first = block.corner + Voxel{0, j, k};
          rest.stock.erase(first, first + Voxel{block.size - 1, 0, 0});
        }
    Ground ground = ground_;
    ground.support = support_ ? &*support_ : nullptr;
    carve_voxelwise(rest, ground, writer_, watch);
  }

  const VoxelGrid& voxels_;
  const Octree& octree_;
  const BlockGraph& graph_;
  const Ground& ground_;
  VoxelSpace space_;
  std::optional<Support> support_;
  NearestBlocks candidates_;
  std::vector<Block> aside_, carved_;
  std::vector<bool> seen_;
  std::vector<std::uint32_t> waiting_;  ///< scratch of `reach`
  RunWriter writer_;
};

}  // namespace

void carve_translating(const VoxelGrid& voxels, const Octree& octree, const BlockGraph& graph, const Ground& ground,
                       const std::function<void(const VoxelRun&)>& emit, const Watch& watch) {
  Carving(voxels, octree, graph, ground, emit).run(watch);
}

void carve_translating(const VoxelGrid& voxels, const Octree& octree, const BlockGraph& graph,
                       const std::function<void(const VoxelRun&)>& emit, const Watch& watch) {
  const Voxel entry = translating_entry(voxels.n());
  carve_translating(voxels, octree, graph, {entry, entry}, emit, watch);
}

}  // namespace sculpt
