// Links against material and against each other along a motion. Internal to verify/.
#pragma once

#include <utility>
#include <vector>

#include "core/verify/findings/replay_finding.hpp"
#include "core/verify/free_ranges.hpp"
#include "core/verify/kept_clearance.hpp"
#include "core/verify/material/standing_voxels.hpp"
#include "core/verify/open_items.hpp"
#include "core/verify/robot/solid_body.hpp"

namespace sculpt {

/// Everything is millimetres. A pair's clearance, once proved, spares it the motions that stay near; material may only
/// shrink between motions.
class LinkReplay {
 public:
  /// All arguments but `apart` (what must be kept apart, apart from the material) must outlive the replay.
  LinkReplay(const Cell& cell, const LinkMotion& motion, const std::vector<SolidBody>& bodies,
             const std::vector<std::pair<const SolidBody*, const SolidBody*>>& apart, const StandingVoxels& material);

  /// To be called before the motions of a piece; what was proved before counts no more. `prove_ahead`: what whole
  /// stretches of the piece cannot touch is found out first. Only for a piece within the joints' limits: elsewhere
  /// joints may be anywhere.
  void look_ahead(const TrajectoryPiece& piece, bool prove_ahead);

  /// A motion, or a part of it, to the keyframe of this index in the piece. Tells at most one contact a pair. Certified
  /// between its ends, except between two meshes and between a mesh and the material where their covers overlap: there
  /// they are tried each quarter of a voxel.
  void replay(std::size_t keyframe, const JointMotion& motion, const OnContact& on_contact);

 private:
  struct Pair {
    const SolidBody* first;
    const SolidBody* second;  // null: the material
    KeptClearance clearance;
    bool sampled;       // a mesh against a mesh or the material
    FreeRanges ranges;  // of the coordinate that moves them, where there is only one
  };

  void add_pair(const SolidBody& first, const SolidBody* second);
  double sphere_gap(const Pair& pair, const std::vector<Frame>& poses) const;
  bool near(const Pair& pair, const std::vector<Frame>& poses, double grow) const;
  bool near_material(const SolidBody& body, const Frame& pose, double grow) const;
  bool may_touch_in(Pair& pair, const OpenItems::Box& box) const;
  void certify(const JointMotion& motion, double middle, double half, const std::vector<Pair*>& open,
               const OnContact& on_contact) const;
  /// True when the pair needs a closer look at the two halves of the interval.
  bool unsettled(const Pair& pair, const std::vector<Frame>& poses, const Configuration& steps, double t,
                 const OnContact& on_contact) const;
  void renew_clearance(Pair& pair, const std::vector<Frame>& poses, const JointMotion& motion) const;

  const Cell& cell_;
  const LinkMotion& motion_;
  const StandingVoxels& material_;
  Vec3 origin_;
  double voxel_;
  std::vector<Pair> pairs_;
  OpenItems ahead_;  // of the pairs
};

}  // namespace sculpt
