// The manipulator at work: where it stands, how it comes to the next voxel, and what it has done so far.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <unordered_map>

#include "core/base/run_context.hpp"
#include "core/collision/scene.hpp"
#include "core/material/support/support.hpp"
#include "core/motion/posture_atlas.hpp"
#include "core/trajectory/keyframe.hpp"

namespace sculpt {

/// What an arm knows besides the keyframes that it emitted: with both another one goes on as it would have.
struct ArmMemory {
  using Path = std::vector<Configuration>;

  std::size_t axis = 0;
  bool outside = true;                            ///< stands clear of the stock
  std::uint64_t last_outside = 0;                 ///< where on the trail it last stood outside the stock
  Path way_out;                                   ///< cached; empty = not known
  std::map<std::size_t, Path> hubs;               ///< per axis: configurations outside the stock that entries came from
  std::uint64_t queries = 0;                      ///< transits asked for
  std::uint64_t ompl_calls = 0, ompl_solved = 0;  ///< how often OMPL was asked for one, and how often it found one
  std::uint64_t in_vain = 0;                      ///< work, in tests of configurations, on transits that were not found
  std::uint64_t cut = 0;                          ///< voxels
  std::uint64_t iterations_left = 0;              ///< of OMPL's searches that may find nothing; each cut gives more
};

/// Every edge it emits is certified against the material that stands at that moment, and it can always go back to home:
/// cut edges are free in both directions once their voxel is gone. For one thread at a time; the same calls give the
/// same keyframes. Throws Cancelled once a stop was asked for.
class Arm {
 public:
  using Emit = std::function<void(const Keyframe&)>;

  /// Stands at `home`, clear of everything. `scene` loses the voxels that are cut; `atlas` is of its chain and grid.
  /// `may_fall`: what cannot be held.
  Arm(Scene& scene, const PostureAtlas& atlas, const VoxelSet& may_fall, const Configuration& home,
      const RunContext& run, Emit emit);

  /// Goes on where another one was, whose keyframes these are, all of them: they are not emitted again. Call first.
  void resume(const std::vector<Keyframe>& keyframes, ArmMemory memory);
  const ArmMemory& memory() const { return memory_; }

  /// The voxel whose centre the ball stands at (or stood at before it left the stock).
  Voxel at() const { return at_; }
  /// The step that led to `at` from the voxel cut before it.
  Voxel last_step() const { return last_step_; }
  const Scene& scene() const { return scene_; }
  const std::vector<Vec3>& axes() const { return atlas_.axes(); }

  /// Does a standing voxel hold nothing that would come free without it? Only such voxels may be cut.
  bool holds_nothing(Voxel voxel) const { return !support_.frees(voxel); }
  /// Could the tool come down `axis` to the voxel, as far as material goes?
  bool fits(Voxel voxel, std::size_t axis) const;

  /// Cuts a voxel next to this one with the axis as it is. False, and nothing done, if that edge is not free.
  bool cut_neighbour(Voxel voxel);
  /// Cuts a voxel after lifting the tool along its axis just far enough, moving across and coming down again.
  bool cut_after_hop(Voxel voxel);
  /// A voxel, and the number of the axis along which the tool comes down to it, which fits.
  struct Descent {
    Voxel voxel;
    std::size_t axis;
  };
  /// Cuts the first voxel of these that it comes to from another direction: leaves the stock, moves freely (OMPL where
  /// the direct edge is not free), comes down. Once far more work was in vain than voxels were cut, it is not tried any
  /// more.
  bool cut_after_transit(std::span<const Descent> descents, int effort);
  /// Looks at these side by side before `cut_after_transit` is called for some of them: spares time, changes no result.
  void look_ahead(std::span<const Descent> descents, int effort);

  /// Leaves the stock and goes home.
  void go_home();

 private:
  using Path = ArmMemory::Path;
  struct Entry {
    Path from_outside;  // first: clear of the stock; last: beside the voxel
    Configuration cut;
  };
  /// Ways in to a voxel along an axis, looked for from one seed after the other.
  struct Approach {
    Voxel voxel;
    std::size_t axis = 0;
    Path seeds;
    std::size_t left_out = 0;    // seeds that were tried before in vain
    std::size_t tried = 0;       // of the seeds
    std::optional<Entry> entry;  // from the last of them that were tried
  };

  Vec3 centre(Voxel voxel) const { return scene_.grid().centre(voxel); }
  std::size_t number_of(Voxel voxel, std::size_t axis) const;
  /// Ball position on the line from the voxel along the axis where the whole tool is outside the grid's cube.
  Vec3 outside(const Vec3& ball_m, const Vec3& axis) const;
  /// Ball position before the cut: on the same line, just clear of the voxel.
  Vec3 beside(Voxel voxel, const Vec3& axis) const;
  bool hop(Voxel voxel, double lift_m);
  bool is_in_vain() const;
  Approach look_at(const Descent& descent, int effort) const;
  bool transit_to_one(std::span<const Descent> descents, int effort);
  bool transit(Approach& approach, int effort);
  /// From where the arm stands to outside the stock, both included; never fails.
  const Path& way_out();
  /// Those with a lower effort than that are left out.
  std::vector<Configuration> entry_seeds(Voxel voxel, std::size_t axis, int from_effort, int effort) const;
  std::optional<Entry> find_entry(Voxel voxel, std::size_t axis, const Configuration& seed) const;
  /// Goes on to the next seed that has an entry.
  void find_next_entry(Approach& approach) const;
  /// Free motion between two configurations outside the stock; empty if none was found.
  Path cross(const Configuration& from, const Configuration& to, int iterations);
  void commit(const Path& moves, const Configuration& cut, Voxel voxel);
  void move(const Path& moves);
  /// Of what was emitted, or is.
  void stand_at(const Keyframe& keyframe);

  Scene& scene_;
  const PostureAtlas& atlas_;
  Support support_;
  Configuration home_;
  RunContext run_;
  Emit emit_;

  Configuration q_;
  Voxel at_, last_step_;
  Path trail_;  // every keyframe since home, home first: walked backwards it is free for ever
  ArmMemory memory_;
  struct InVain {
    std::uint64_t cut;  // voxels, then
    int effort;
    std::size_t seeds;
  };
  struct LookedAhead {
    std::uint64_t cut = 0;  // voxels, then
    int effort = 0;
    std::unordered_map<std::size_t, Approach> approaches;  // by voxel and axis
  };
  LookedAhead looked_ahead_;
  std::unordered_map<std::size_t, InVain> no_entry_;  // by voxel and axis; spares work, changes no result
};

}  // namespace sculpt
