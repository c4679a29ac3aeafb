// Ball and shank against material and links along a motion. Internal to verify/.
#pragma once

#include "core/verify/approach_bound.hpp"
#include "core/verify/findings/replay_finding.hpp"
#include "core/verify/material/standing_voxels.hpp"
#include "core/verify/open_items.hpp"
#include "core/verify/robot/solid_body.hpp"

namespace sculpt {

/// Millimetres. Where a link could be grown by its motion, the tool is swept instead: it may pass a wall at a twentieth
/// of a voxel.
class ToolReplay {
 public:
  /// All arguments must outlive the replay.
  ToolReplay(const Cell& cell, const Tool& tool, const LinkMotion& motion, const std::vector<SolidBody>& bodies,
             const StandingVoxels& material);

  /// To be called before the motions of a piece. `prove_ahead`: what whole stretches of the piece cannot touch is found
  /// out first. Only for a piece within the joints' limits: elsewhere joints may be anywhere.
  void look_ahead(const TrajectoryPiece& piece, bool prove_ahead);

  /// A motion, or a part of it, to the keyframe of this index in the piece. Tells at most one contact for each part of
  /// the tool and each thing it can touch.
  void replay(std::size_t keyframe, const JointMotion& motion, const OnContact& on_contact);

  /// Whether this is proved of a cut of a straight run, of two voxels or more: it removes each within the tolerance
  /// of its centre, and until then stays clear of it. Only ends and planes between the voxels are looked at.
  bool keeps_off_the_rest(const JointMotion& motion, Voxel first, Voxel last, double tolerance_mm);

  /// The ball's centre in the stock frame.
  Vec3 ball_at(const Configuration& q);

 private:
  struct Line {
    Vec3 ball = Vec3::Zero(), top = Vec3::Zero();
  };
  /// The tool at one configuration, seen from a link.
  struct Placed {
    Configuration q;
    LinkChain::Place place;
    Line line;
  };
  /// What moves with one link, and so sees the tool move in one way.
  struct View {
    int link;
    LinkChain chain;  // from that link to the tool
    Placed before, after;
  };
  struct Target {
    const SolidBody* body;  // null: the material
    std::size_t view;
    Frame from_view;  // to the target's frame
    int link;
    Frame pose;      // of the target's frame in its link
    Vec3 low, high;  // box around it in its own frame
    ApproachBound approach;
  };
  struct Task {
    const Target* target;
    bool shank;
  };
  struct Sweep {
    Line start, end;  // in the target's frame
    double sagitta;   // how far any point of the line strays from the straight way between start and end
  };
  /// A part of a motion.
  struct Stretch {
    const JointMotion& motion;
    const View& view;
    double from, to;  // of the motion
    const Placed &start, &end;
  };
  enum class Finding { free, touches, too_close, unknown };

  void add_target(const LinkMotion& motion, Target target);
  bool has_shank() const { return shank_ > 0 && stickout_ > 0; }
  void place(const Configuration& q, const View& view, Placed& placed) const;
  void place_ends(const JointMotion& motion, View& view) const;
  Line seen_from(const Target& target, const Line& line) const;
  bool touches(const Target& target, const fcl::CollisionGeometryd& part, const Frame& pose, const Vec3& low,
               const Vec3& high) const;
  bool ball_meets(const Target& target, const Vec3& from, const Vec3& to, double grow) const;
  bool shank_meets(const Target& target, const Line& line, double grow, double longer) const;
  bool swept_shank_meets(const Target& target, const Sweep& sweep) const;
  bool comes_near(const Target& target, const std::vector<Frame>& poses, double grow) const;
  double sagitta(const LinkChain& chain, const Placed& start, const Placed& end, const Configuration& step) const;
  bool is_clear(const Target& target, const JointMotion& motion) const;
  Finding settle(const Task& task, const Placed& start, const Placed& middle, const Placed& end,
                 const Configuration& step) const;
  void certify(const Stretch& stretch, const std::vector<Task>& open, const OnContact& on_contact) const;

  const Cell& cell_;
  const LinkMotion& motion_;
  const StandingVoxels& material_;
  double voxel_, ball_, shank_, stickout_;
  std::vector<View> views_;
  std::vector<Target> targets_;
  OpenItems ahead_;  // of the targets
};

}  // namespace sculpt
