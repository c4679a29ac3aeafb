// The arm of a plan with milling tools: from tool to tool, from direction to direction, and along strokes in between.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "core/base/run_context.hpp"
#include "core/mill/drive/mill_follow.hpp"

namespace sculpt {

/// What an arm knows at home, besides the tool in its spindle.
struct MillArmMemory {
  std::map<int, std::vector<Configuration>> ways;  ///< from home to where each direction was entered last
  std::set<int> searched;                          ///< for ways to these
  std::uint64_t transits = 0;
};

/// Begins at home with a tool in its spindle; every edge that it emits is certified. Not shared between threads.
class MillArm {
 public:
  using Emit = std::function<void(std::vector<Keyframe>)>;

  /// `home`, `change`: where tools are changed, at rest. `emit` and `run` must outlive the object.
  MillArm(const Configuration& home, const Configuration& change, const Emit& emit, const RunContext& run)
      : home_(home), change_(change), emit_(emit), run_(run), q_(home) {}

  /// Takes the tool of this number, which has seen what stands: from its direction home, to where tools are changed,
  /// where it rests, and home again. The first one is in the spindle at the start. Throws InputError `no_transit` where
  /// no way leads there.
  void take_tool(int number, const HeldTool& held);
  /// Is at home with this tool, as another arm was that had taken it and knew this.
  void go_on(const HeldTool& held, MillArmMemory known);
  /// Of an arm that has just taken a tool.
  const MillArmMemory& memory() const { return known_; }

  /// Holds the tool in this direction, its tip at `tip`, which must be in the field, outside the stock. False if there
  /// is no way. It goes there with the first strokes: where none follow it was never there.
  bool hold(const PostureField& field, int direction, const Vec3& tip);
  /// Follows strokes from where the tip is; gives how many were followed to their end.
  FollowedMill try_strokes(const std::vector<MillStroke>& strokes) const;
  /// Goes there.
  void commit(FollowedMill followed);

  /// Where the tip is; nothing where the tool is not held in a direction.
  std::optional<Vec3> tip() const { return tip_; }
  /// From outside the stock, back the way it came or another one. Throws InputError `no_transit`.
  void go_home();

 private:
  /// `direction`: that it is for; -1: to rest.
  std::vector<Configuration> find_way(const Configuration& to, int direction);
  /// `turning`: coordinates that move the stock alone.
  std::vector<Configuration> way_by_turning(const Configuration& to, const std::vector<int>& turning) const;
  std::vector<Configuration> way_as_elsewhere(const Configuration& to, const std::vector<int>& turning) const;
  std::vector<Configuration> way_by_home(const std::vector<Configuration>& places, const Configuration& to) const;
  bool is_free(const Configuration& from, const Configuration& to) const;
  std::vector<Keyframe> moves(const std::vector<Configuration>& way);
  void move(const std::vector<Configuration>& way);
  void drop_entry();
  void go_over(const Configuration& to);

  Configuration home_, change_;
  const Emit& emit_;
  const RunContext& run_;
  Configuration q_;
  const HeldTool* held_ = nullptr;
  const PostureField* field_ = nullptr;
  int direction_ = -1;
  std::optional<Vec3> tip_;
  /// The way into the direction, not gone yet, and what was before it.
  struct Entry {
    std::vector<Keyframe> keyframes;
    Configuration q;
    std::vector<Configuration> way_home;
  };
  std::optional<Entry> entry_;
  MillArmMemory known_;
  std::vector<Configuration> way_home_;  ///< from where the direction was entered; empty at home
};

}  // namespace sculpt
