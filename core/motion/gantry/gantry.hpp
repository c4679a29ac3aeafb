// Voxel runs of the translating robot -> certified keyframes.
#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/collision/scene.hpp"
#include "core/search/voxel_run.hpp"
#include "core/trajectory/keyframe.hpp"

namespace sculpt {

/// A step that is not free, and how many keyframes had been emitted when a run with it was begun. Of the way from home
/// to where the first run starts, `from` and `to` are both the latter.
struct Refusal {
  std::uint64_t keyframes = 0;
  Voxel from, to;
};

/// Where a gantry goes on: the first `keyframes` were certified and emitted by another one that followed the same runs,
/// and all of `refusals` were its own. That is not done again.
struct GantryStart {
  std::uint64_t keyframes = 0;
  std::vector<Refusal> refusals;
};

/// Who hears of a gantry.
struct GantryListener {
  std::function<void(const Keyframe&)> emit;
  std::function<void(const Refusal&)> refused = [](const Refusal&) {};  ///< another that goes on here must know of it
  std::function<void()> caught_up = [] {};                              ///< what another one did is over
  std::function<void()> stopped = [] {};  ///< another could go on here, though no keyframe was just emitted
};

/// Follows runs with a chain of prismatic joints. `scene` loses the voxels that are cut. Single-threaded.
class Gantry {
 public:
  /// Stands at `home`. `listener` must outlive the object.
  Gantry(Scene& scene, const Configuration& home, std::uint64_t seed, std::stop_token stop, GantryStart start,
         const GantryListener& listener);

  /// Where runs begin that follow; before any was followed.
  void begin_at(Voxel entry) { at_ = entry; }
  /// The first run begins with the way from home to there. Throws the Refusal of the first step that is not
  /// free; what comes before it in a cut is done then. Throws Cancelled.
  void follow(const VoxelRun& run);
  /// Is all that was known over, and something done?
  bool is_on_its_own() const { return emitted_ > 0 && emitted_ >= known_.keyframes; }
  /// Has it left home?
  bool entered() const { return !way_in_.empty(); }
  /// Where the ball is, once it entered.
  Voxel at() const { return at_; }
  /// From where it entered. Throws InputError `no_transit` if there is no way.
  void go_home();

 private:
  std::optional<JointBox> reach() const;
  std::optional<Configuration> configuration_at(Voxel voxel) const;
  void enter();
  void travel(Voxel to);
  void cut(Voxel first, Voxel last);
  void move(const Configuration& q);
  void keep_cut(const Configuration& q, Voxel first, Voxel last);
  bool is_free(const Configuration& from, const Configuration& to, std::optional<Voxel> exempt) const;
  bool is_free_run(const Configuration& from, const Configuration& to, const VoxelLine& run) const;
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
  GantryStart known_;
  const GantryListener& listener_;
  std::size_t refused_ = 0;  ///< how many steps were
  std::uint64_t emitted_ = 0;
};

}  // namespace sculpt
