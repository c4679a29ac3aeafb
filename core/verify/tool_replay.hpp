// Ball and shank against material and links along a motion. Internal to verify/.
#pragma once

#include "core/verify/kept_clearance.hpp"
#include "core/verify/open_items.hpp"
#include "core/verify/replay_finding.hpp"
#include "core/verify/robot/solid_body.hpp"
#include "core/verify/standing_voxels.hpp"

namespace sculpt {

/// Millimetres. Where a link could be grown by its motion, the tool is swept instead: it may pass a wall at a twentieth
/// of a voxel. A clearance from a link, once proved, spares it the motions that stay near.
class ToolReplay {
 public:
  /// All arguments must outlive the replay.
  ToolReplay(const Cell& cell, const Tool& tool, const LinkMotion& motion, const std::vector<SolidBody>& bodies,
             const StandingVoxels& material, double voxel_mm);

  /// To be called before the motions of a piece; what was proved before counts no more. `in_limits`: all of the piece
  /// is within the joints' limits; elsewhere joints may be anywhere, and nothing is proved ahead.
  void look_ahead(const TrajectoryPiece& piece, bool in_limits);

  /// A motion, or a part of it, to the keyframe of this index in the piece. Tells at most one contact for each part of
  /// the tool and each thing it can touch.
  void replay(std::size_t keyframe, const JointMotion& motion, const OnContact& on_contact);

  /// Whether this is proved of a cut of a straight run, of two voxels or more: it removes each within the tolerance
  /// of its centre, and until then stays clear of it. Only ends and planes between the voxels are looked at.
  bool keeps_off_the_rest(const JointMotion& motion, Voxel first, Voxel last, double tolerance_mm) const;

  /// The ball's centre in the stock frame.
  Vec3 ball_at(const Configuration& q) const;

 private:
  struct Target {
    const SolidBody* body;  // null: the material
    Frame pose;             // of the target's frame in its link
    int link;
    std::vector<MovingJoint> joints;  // from the target to the tool
    Vec3 low, high;                   // box around it in its own frame
    KeptClearance clearance;          // of the whole tool; not kept for the material
  };
  struct Task {
    const Target* target;
    bool shank;
  };
  struct Line {
    Vec3 ball, top;
  };
  struct Sweep {
    Line start, end, middle;  // in the target's frame
    double sagitta;           // how far any point of the line strays from the straight way between start and end
  };
  enum class Finding { free, touches, too_close, unknown };

  Line line_in(const Target& target, const std::vector<Frame>& poses) const;
  Line line_in_material(const Configuration& q) const;
  void place_ends(const Configuration& q, bool all, std::vector<Frame>& poses) const;
  bool touches(const Target& target, const fcl::CollisionGeometryd& part, const Frame& pose, const Vec3& low,
               const Vec3& high) const;
  bool ball_meets(const Target& target, const Vec3& from, const Vec3& to, double grow) const;
  bool shank_meets(const Target& target, const Line& line, double grow, double longer) const;
  bool swept_shank_meets(const Target& target, const Sweep& sweep) const;
  bool comes_near(const Target& target, const std::vector<Frame>& poses, double grow) const;
  void renew_clearance(Target& target, const std::vector<Frame>& poses, const JointMotion& motion) const;
  Finding settle(const Task& task, const std::vector<Frame>& start, const std::vector<Frame>& middle,
                 const std::vector<Frame>& end, const Configuration& steps) const;
  void certify(const JointMotion& motion, double from, double to, const std::vector<Frame>& start,
               const std::vector<Frame>& end, const std::vector<Task>& open, const OnContact& on_contact) const;

  const Cell& cell_;
  const LinkMotion& motion_;
  const StandingVoxels& material_;
  double voxel_, ball_, shank_, stickout_;
  std::vector<Target> targets_;
  OpenItems ahead_;  // of the targets
};

}  // namespace sculpt
