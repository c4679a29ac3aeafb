// Voxel runs of the translating robot -> certified keyframes.
#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/collision/scene.hpp"
#include "core/search/translating.hpp"
#include "core/trajectory/keyframe.hpp"

namespace sculpt {

/// A step that is not free, and how many keyframes had been emitted when a run with it was begun. Of the way from home
/// to where the first run starts, `from` and `to` are both the latter.
struct Refusal {
  std::uint64_t keyframes = 0;
  Voxel from, to;
};

/// Follows runs with a chain of prismatic joints. `scene` loses the voxels that are cut. Single-threaded.
class Gantry {
 public:
  using Emit = std::function<void(const Keyframe&)>;

  /// Stands at `home`. The first `known` keyframes were certified and emitted by another one that followed the same
  /// runs, and all of `refusals` were its own: that is not done again. `caught_up` is called when they are over.
  Gantry(
      Scene& scene, const Configuration& home, std::uint64_t seed, std::stop_token stop, Emit emit,
      std::vector<Refusal>& refusals, std::uint64_t known = 0, std::function<void()> caught_up = [] {});

  /// Where runs begin that follow; before any was followed.
  void begin_at(Voxel entry) { at_ = entry; }
  /// The first run begins with the way from home to there. Throws the Refusal of the first step that is not
  /// free, which is added to `refusals`; what comes before it in a cut is done then.
  void follow(const VoxelRun& run);
  /// Is all that was known over, and something done?
  bool is_on_its_own() const { return emitted_ > 0 && emitted_ >= known_; }
  /// Has it left home?
  bool entered() const { return !way_in_.empty(); }
  /// Where the ball is, once it entered.
  Voxel at() const { return at_; }
  /// From where it entered. Throws InputError `no_transit` if there is no way.
  void go_home();

 private:
  std::optional<Configuration> configuration_at(Voxel voxel) const;
  void enter();
  void travel(Voxel to);
  void cut(Voxel first, Voxel last);
  void move(const Configuration& q);
  void keep_cut(const Configuration& q, Voxel first, Voxel last);
  bool is_free(const Configuration& from, const Configuration& to, std::optional<Voxel> exempt) const;
  /// What was refused in the run that begins now, by the one that followed it before.
  const Refusal* known_refusal() const;
  /// Of the run that begins now. To be thrown.
  Refusal note_refusal(Voxel from, Voxel to);
  void emit(const Keyframe& keyframe);

  Scene& scene_;
  Configuration home_, q_;
  std::uint64_t seed_;
  std::stop_token stop_;
  Voxel at_;
  std::vector<Configuration> way_in_;  ///< from home; empty before it left
  Emit emit_;
  std::vector<Refusal>& refusals_;
  std::size_t refused_ = 0;  ///< of `refusals_`, those that were met
  std::uint64_t emitted_ = 0, known_;
  std::function<void()> caught_up_;
};

}  // namespace sculpt
