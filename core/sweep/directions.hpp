// The ways in which a sweep holds the tool: directions of its axis, each with a field of configurations.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/run_context.hpp"
#include "core/sweep/field/field_store.hpp"
#include "core/sweep/reach/reach_rows.hpp"
#include "core/sweep/stock_turn.hpp"

namespace sculpt {

/// Straight directions are looked at again for what stands, where something is wanted. Both as `blocks_of` has them.
struct Opening {
  VoxelSet standing, wanted;
};

/// By number: the straight ones (tool_views), some of them more than once, with fields that cover different parts;
/// then the tilted ones, whose fields are found when they are first asked for; then straight ones again, with fields
/// for what stood when they were opened. Not shared between threads.
class Directions {
 public:
  /// `scene` must outlive the object. `store`: of this scene, home and seed.
  Directions(const Scene& scene, const Configuration& home, const RunContext& run, FieldStore store = {});

  /// The fields of all straight directions, and with them their numbers. To be called first. Throws Cancelled.
  void find_straight_fields();

  /// Looks again at straight directions where the full stock was in the way of links, now that only this stands. Says
  /// whether it found new ones. Throws Cancelled.
  bool open(const Opening& opening);
  /// Voxels as a coarser grid, of blocks in which any are.
  static VoxelSet blocks_of(const VoxelSet& voxels);

  /// The coordinate that turns the stock under the arm, if there is one.
  std::optional<int> stock_turn() const { return turn_ ? std::optional(turn_->coordinate) : std::nullopt; }

  std::size_t size() const { return ways_.size(); }
  bool is_straight(std::size_t direction) const { return ways_[direction].view.lean == Voxel{0, 0, 1}; }
  const ToolView& view(std::size_t direction) const { return ways_[direction].view; }
  /// Throws Cancelled.
  const PostureField& field(std::size_t direction);
  bool is_found(std::size_t direction) const { return ways_[direction].field != nullptr; }
  /// The tilted directions whose fields were found.
  std::vector<std::size_t> tilted_found() const;
  /// Which of them has this field, one that was found.
  std::size_t number_of(const PostureField& field) const;
  /// Where the field of a straight direction is usable.
  const ReachRows& reach(std::size_t direction) const { return *ways_[direction].reach; }
  /// May the ball's centre be at this cell, for links and limits? True where the field is not known.
  bool may_reach(std::size_t direction, const Vec3& cell) const {
    const Way& way = ways_[direction];
    return !way.field || way.field->usable(cell);
  }

 private:
  using Fields = std::vector<std::unique_ptr<PostureField>>;

  struct Way {
    ToolView view;
    std::unique_ptr<PostureField> field = {};
    std::optional<ReachRows> reach = {};
    std::optional<std::size_t> opens = {};  ///< which one, with less in its way
  };

  Fields search(const ToolView& view, std::uint64_t number) const;
  Fields search_anew(const ToolView& view, std::uint64_t number) const;
  std::unique_ptr<PostureField> find_tilted(std::size_t direction);
  void find_reach(Way& way) const;

  const Scene& scene_;
  Configuration home_;
  RunContext run_;
  FieldStore store_;
  std::optional<StockTurn> turn_;
  std::vector<Way> ways_;
  std::size_t straight_ = 0;  ///< that many come before the tilted ones
};

}  // namespace sculpt
