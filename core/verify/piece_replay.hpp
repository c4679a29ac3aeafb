// A piece of a trajectory -> what is wrong with it. Internal to verify/.
#pragma once

#include <vector>

#include "core/material/voxel_grid.hpp"
#include "core/verify/findings/findings.hpp"
#include "core/verify/link_replay.hpp"
#include "core/verify/robot/checked_pairs.hpp"
#include "core/verify/tool_replay.hpp"
#include "core/verify/trajectory_pieces.hpp"

namespace sculpt {

/// What all workers of a replay share; nobody changes it.
struct ReplayScene {
  ReplayScene(const Cell& cell, const VoxelGrid& voxels, const TrajectoryHeader& header, std::vector<int> joints,
              bool thorough);

  const Cell& cell;
  const VoxelGrid& voxels;
  const TrajectoryHeader& header;
  std::vector<int> joints;  ///< robot joint of each coordinate
  Grid grid;                ///< of the cell, not of the header
  Tool tool;
  LinkMotion motion;
  std::vector<SolidBody> bodies;
  CheckedPairs pairs;
  bool thorough;  ///< FCL decides all, motion by motion
};

/// Finds the joints of `q` outside their limits.
void find_broken_limits(const ReplayScene& scene, const Configuration& q, std::uint64_t line, PieceFindings& found);

/// A worker with a material of its own. Not shared between threads.
class PieceReplay {
 public:
  /// The scene must outlive this.
  PieceReplay(const ReplayScene& scene, const VoxelSet& standing);

  /// Applies the removals of a piece that somebody else replays.
  void skip(const TrajectoryPiece& piece);

  /// `step` is called before every motion or part of one; what it throws passes through.
  PieceFindings replay(const TrajectoryPiece& piece, const std::function<void()>& step);

  VoxelSet left() const { return material_.voxels(); }

 private:
  bool within_limits(const Configuration& q) const;
  void replay_keyframe(const Configuration& from, const Keyframe& keyframe);
  bool run_is_free(const JointMotion& motion, const Keyframe& keyframe);
  void replay_parts(const JointMotion& whole, const Keyframe& keyframe, bool possible);
  void remove_voxel(Voxel voxel, const Configuration& q);
  void find(std::string sentence) { found_.find(line_, std::move(sentence)); }

  const ReplayScene& scene_;
  StandingVoxels material_;
  ToolReplay tool_;
  LinkReplay links_;
  PieceFindings found_;
  std::uint64_t line_ = 0;
  std::size_t index_ = 0;  // of the keyframe, in its piece
  const std::function<void()>* step_ = nullptr;
};

}  // namespace sculpt
