// The arm of a sweep: from one tool direction to the next by way of their hubs, and along strokes in between.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/base/watch.hpp"
#include "core/sweep/follow.hpp"

namespace sculpt {

/// What an arm knows besides the keyframes that it emitted and the direction it is in.
struct HubArmMemory {
  std::uint64_t transits = 0;           ///< to a hub
  Vec3 at = Vec3::Zero();               ///< the ball, in cells of the view of the direction
  std::vector<Configuration> way_home;  ///< from the hub of the direction
};

/// Begins at home and remembers its way back there. Every edge it emits is certified. Not shared between threads.
class HubArm {
 public:
  using Emit = std::function<void(std::vector<Keyframe>)>;

  /// `turn`: the coordinate that turns the stock, if there is one. `scene`, `emit` and `watch` must outlive the object.
  HubArm(const Scene& scene, const Configuration& home, std::optional<int> turn, std::uint64_t seed, const Emit& emit,
         const Watch& watch)
      : scene_(scene), home_(home), turn_(turn), seed_(seed), emit_(emit), watch_(watch), q_(home) {}

  /// Goes on where another one was: at `q`, in `field` if not at home.
  void resume(HubArmMemory memory, const Configuration& q, const PostureField* field);
  const HubArmMemory& memory() const { return memory_; }

  /// How to go over to the hub of a direction.
  struct Entry {
    const PostureField* field;
    std::vector<Configuration> path;  ///< from where the arm is
    std::vector<Configuration> back;  ///< from there home
  };
  /// Nothing if there is no way. Any thread, while the arm stays where it is. Throws Cancelled.
  std::optional<Entry> find_entry(const PostureField& field) const;
  void enter(Entry entry);
  /// Both. False, and nothing done, if there is no way.
  bool enter(const PostureField& field);
  /// Of the direction in use; none at home.
  const PostureField* field() const { return field_; }
  /// The ball, in cells of the view of that direction.
  const Vec3& at() const { return memory_.at; }

  /// What it would do in a direction from `from` on. Any thread.
  FollowedStrokes try_strokes(const PostureField& field, const Vec3& from, const std::vector<Stroke>& strokes) const;
  /// Emits what was followed, from where the arm is, and says how many strokes that is.
  std::size_t commit(FollowedStrokes followed, const std::vector<Stroke>& strokes);
  /// Voxels, since it was made.
  std::uint64_t removed() const { return removed_; }

  /// Throws InputError `no_transit` where not even the way it came is open, Cancelled.
  void go_home();

 private:
  std::vector<Configuration> find_way(const std::vector<Configuration>& back, const Configuration& to) const;
  std::vector<Configuration> find_transit(const Configuration& to) const;
  std::optional<std::vector<Configuration>> way_home() const;
  void move(const std::vector<Configuration>& way);
  void emit(std::vector<Keyframe> keyframes) const;

  const Scene& scene_;
  Configuration home_;
  std::optional<int> turn_;
  std::uint64_t seed_, removed_ = 0;
  const Emit& emit_;
  const Watch& watch_;
  Configuration q_;
  const PostureField* field_ = nullptr;
  HubArmMemory memory_;
};

}  // namespace sculpt
