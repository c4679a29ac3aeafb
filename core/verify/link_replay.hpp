// Links against material and against each other along a motion. Internal to verify/.
#pragma once

#include "core/verify/link_motion.hpp"
#include "core/verify/replay_finding.hpp"
#include "core/verify/solid_body.hpp"
#include "core/verify/standing_voxels.hpp"

namespace sculpt {

/// Everything is millimetres. Motions must follow one another: a pair's clearance, once proved, is used up over the
/// motions after.
class LinkReplay {
 public:
  /// All arguments must outlive the replay.
  LinkReplay(const Cell& cell, const LinkMotion& motion, const std::vector<SolidBody>& bodies,
             const StandingVoxels& material, double voxel_mm);

  /// Tells at most one contact a pair. Certified between its ends, except between two meshes and between a mesh and the
  /// material where their covers overlap: there they are tried each quarter of a voxel.
  void replay(const JointMotion& motion, const OnContact& on_contact);

  /// The next motion starts elsewhere.
  void forget();

 private:
  struct Pair {
    const SolidBody* first;
    const SolidBody* second;          // null: the material
    std::vector<MovingJoint> joints;  // from `second` (or the stock link) to `first`
    std::vector<MovingJoint> back;    // the other way round
    bool sampled;                     // a mesh against a mesh or the material
    double clearance = 0;             // proved for where the last motion ended
  };

  void add_pair(const SolidBody& first, const SolidBody* second);
  double approach_limit(const Pair& pair, const std::vector<Frame>& poses, const Configuration& steps) const;
  double sphere_gap(const Pair& pair, const std::vector<Frame>& poses) const;
  bool near(const Pair& pair, const std::vector<Frame>& poses, double grow) const;
  bool near_material(const SolidBody& body, const Frame& pose, double grow) const;
  void certify(const JointMotion& motion, double middle, double half, const std::vector<Pair*>& open,
               const OnContact& on_contact);
  /// True when the pair needs a closer look at the two halves of the interval.
  bool unsettled(Pair& pair, const std::vector<Frame>& poses, const Configuration& steps, double t,
                 const OnContact& on_contact);
  void renew_clearance(Pair& pair, const std::vector<Frame>& poses, double travel);

  const Cell& cell_;
  const LinkMotion& motion_;
  const StandingVoxels& material_;
  Vec3 origin_;
  double voxel_;
  std::vector<Pair> pairs_;
};

}  // namespace sculpt
