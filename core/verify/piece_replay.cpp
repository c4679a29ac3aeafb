#include "core/verify/piece_replay.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/verify/findings/finding_text.hpp"
#include "core/verify/findings/slack.hpp"

namespace sculpt {
namespace {

constexpr double tolerance_slack_m = 1e-9;

// The voxels of a cut, in order; of none if it is a move.
class Run {
 public:
  explicit Run(const Keyframe& keyframe)
      : first_(keyframe.first), way_(sign(keyframe.last - keyframe.first)), length_(run_length(keyframe)) {}

  int length() const { return length_; }
  Voxel operator[](int part) const { return first_ + way_ * part; }

 private:
  Voxel first_, way_;
  int length_;
};

bool within_limits(const Joint& joint, double value) {
  return value >= joint.lower - joint_slack && value <= joint.upper + joint_slack;
}

}  // namespace

ReplayScene::ReplayScene(const Cell& the_cell, const VoxelGrid& the_voxels, const TrajectoryHeader& the_header,
                         std::vector<int> the_joints, bool is_thorough)
    : cell(the_cell),
      voxels(the_voxels),
      header(the_header),
      joints(std::move(the_joints)),
      grid(cell.grid(voxels.n())),
      tool(make_tool(cell.tool, grid.voxel_m)),
      motion(cell.robot, joints, cell.rest, cell.stock_link),
      bodies(make_solid_bodies(cell.robot)),
      pairs(choose_pairs(cell, joints, motion, bodies)),
      thorough(is_thorough) {}

void find_broken_limits(const ReplayScene& scene, const Configuration& q, std::uint64_t line, PieceFindings& found) {
  for (std::size_t at = 0; at < scene.joints.size(); ++at) {
    const Joint& joint = scene.cell.robot.joints[static_cast<std::size_t>(scene.joints[at])];
    const double value = q[static_cast<Eigen::Index>(at)];
    if (!within_limits(joint, value))
      found.find(line, "joint " + joint.name + " at " + text(value) + " is outside its limits " + text(joint.lower) +
                           " to " + text(joint.upper));
  }
}

PieceReplay::PieceReplay(const ReplayScene& scene, const VoxelSet& standing)
    : scene_(scene),
      material_(standing, 1000 * scene.grid.voxel_m, scene.thorough),
      tool_(scene.cell, scene.tool, scene.motion, scene.bodies, material_),
      links_(scene.cell, scene.motion, scene.bodies, scene.pairs.checked, material_) {}

void PieceReplay::skip(const TrajectoryPiece& piece) {
  for (const Keyframe& keyframe : piece.keyframes) {
    const Run run(keyframe);
    for (int part = 0; part < run.length(); ++part) material_.remove(run[part]);
  }
}

PieceFindings PieceReplay::replay(const TrajectoryPiece& piece, const std::function<void()>& step) {
  found_ = {};
  step_ = &step;
  line_ = piece.first_line;
  // What this worker proved before depends on which pieces it got.
  const bool prove_ahead =
      !scene_.thorough && within_limits(piece.from) &&
      std::ranges::all_of(piece.keyframes, [this](const Keyframe& keyframe) { return within_limits(keyframe.q); });
  links_.look_ahead(piece, prove_ahead);
  tool_.look_ahead(piece, prove_ahead);
  const Configuration* from = &piece.from;
  for (index_ = 0; index_ < piece.keyframes.size(); ++index_, ++line_) {
    const Keyframe& keyframe = piece.keyframes[index_];
    find_broken_limits(scene_, keyframe.q, line_, found_);
    replay_keyframe(*from, keyframe);
    from = &keyframe.q;
  }
  return std::move(found_);
}

bool PieceReplay::within_limits(const Configuration& q) const {
  for (std::size_t at = 0; at < scene_.joints.size(); ++at)
    if (!sculpt::within_limits(scene_.cell.robot.joints[static_cast<std::size_t>(scene_.joints[at])],
                               q[static_cast<Eigen::Index>(at)]))
      return false;
  return true;
}

void PieceReplay::replay_keyframe(const Configuration& from, const Keyframe& keyframe) {
  // Out of its limits a joint can be anywhere: the finding is made, and a replay could take for ever.
  const bool possible = within_limits(from) && within_limits(keyframe.q);
  const JointMotion whole(from, keyframe.q);
  if (possible && run_length(keyframe) > 1) {
    (*step_)();
    if (run_is_free(whole, keyframe)) return;
  }
  replay_parts(whole, keyframe, possible);
}

// A run of voxels at once. The links are tried against all of it, the tool against what is left of the material after
// it; in between, the tool must keep off what it has yet to cut. Where this cannot be proved nothing is said: the parts
// of the run then decide.
bool PieceReplay::run_is_free(const JointMotion& motion, const Keyframe& keyframe) {
  const Run run(keyframe);
  for (int part = 0; part < run.length(); ++part)
    if (scene_.voxels.label(run[part]) != Label::remove || !material_.contains(run[part])) return false;
  if (!tool_.keeps_off_the_rest(motion, keyframe.first, keyframe.last, 1000 * scene_.header.tolerance_m)) return false;
  bool free = true;
  const auto on_contact = [&free](const std::string&, double) { free = false; };
  links_.replay(index_, motion, on_contact);
  if (!free) return false;
  for (int part = 0; part < run.length(); ++part) material_.remove(run[part]);
  tool_.replay(index_, motion, on_contact);
  if (free) {
    found_.voxels_checked += static_cast<std::uint64_t>(run.length());
  } else {
    for (int part = 0; part < run.length(); ++part) material_.put_back(run[part]);
  }
  return free;
}

void PieceReplay::replay_parts(const JointMotion& whole, const Keyframe& keyframe, bool possible) {
  const Run run(keyframe);
  const int parts = std::max(1, run.length());
  for (int part = 0; part < parts; ++part) {
    (*step_)();
    const double begin = static_cast<double>(part) / parts, end = static_cast<double>(part + 1) / parts;
    const JointMotion motion(whole.at(begin), whole.at(end));
    const auto on_contact = [&](const std::string& what, double t) {
      find(what + " at " + text(100 * (begin + t * (end - begin))) + " % of the motion to this keyframe");
    };
    if (possible)
      links_.replay(index_, motion, on_contact);  // links may not even touch the voxel that the tool is about to cut
    if (keyframe.cut) remove_voxel(run[part], whole.at(end));
    if (possible) tool_.replay(index_, motion, on_contact);
  }
}

void PieceReplay::remove_voxel(Voxel voxel, const Configuration& q) {
  ++found_.voxels_checked;
  const double miss_m = (tool_.ball_at(q) / 1000 - scene_.grid.centre(voxel)).norm();
  if (!(miss_m <= scene_.header.tolerance_m + tolerance_slack_m))
    find("the ball is " + text(miss_m / scene_.header.grid.voxel_m) + " voxels from the centre of voxel " +
         text(voxel) + " that it removes");
  switch (scene_.voxels.label(voxel)) {
    case Label::air:
      find("voxel " + text(voxel) + " is removed but was air from the start");
      break;
    case Label::keep:
      find("voxel " + text(voxel) + " is removed but belongs to the target");
      break;
    case Label::remove:
      if (!material_.contains(voxel)) find("voxel " + text(voxel) + " is removed a second time");
  }
  material_.remove(voxel);
}

}  // namespace sculpt
