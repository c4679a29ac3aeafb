#include "core/verify/verify.hpp"

#include <algorithm>
#include <cmath>
#include <istream>
#include <sstream>

#include "core/trajectory/trajectory.hpp"
#include "core/verify/link_replay.hpp"
#include "core/verify/tool_replay.hpp"

namespace sculpt {
namespace {

constexpr std::size_t listed_findings = 100;
constexpr double largest_tolerance_voxels = 0.04;
constexpr double joint_slack = 1e-9;
// Joint values are stored in steps of 1e-7 rad or m, rounded to the inside of the limits: home may be that far aside.
constexpr double home_slack = 1e-7 + joint_slack;
constexpr double length_slack_m = 1e-12;

std::string text(Voxel v) {
  return "(" + std::to_string(v.i) + ", " + std::to_string(v.j) + ", " + std::to_string(v.k) + ")";
}

std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

// Whole lines from here on; the stream stands where it stood. 0 where it cannot be rewound.
std::uint64_t count_lines(std::istream& in) {
  const auto start = in.tellg();
  if (start < 0) {
    in.clear();
    return 0;
  }
  std::uint64_t lines = 0;
  std::vector<char> piece(1 << 16);
  while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())), in.gcount() > 0)
    lines += static_cast<std::uint64_t>(std::count(piece.begin(), piece.begin() + in.gcount(), '\n'));
  in.clear();
  in.seekg(start);
  return lines;
}

// The joints that a trajectory of this cell must name: the independent ones on the way from the stock to the tool.
std::vector<int> expected_joints(const Cell& cell) {
  std::vector<int> joints;
  for (int joint : LinkMotion::path(cell.robot, cell.stock_link, cell.tool_link)) {
    const auto& all = cell.robot.joints;
    for (std::size_t hops = 0; all[static_cast<std::size_t>(joint)].mimic >= 0 && hops < all.size(); ++hops)
      joint = all[static_cast<std::size_t>(joint)].mimic;
    if (all[static_cast<std::size_t>(joint)].kind == JointKind::fixed) continue;
    if (std::find(joints.begin(), joints.end(), joint) == joints.end()) joints.push_back(joint);
  }
  return joints;
}

class Replay {
 public:
  Replay(std::istream& in, const Cell& cell, const VoxelGrid& voxels, const Watch& watch)
      : cell_(cell),
        voxels_(voxels),
        watch_(watch),
        lines_(count_lines(in)),
        reader_(in),
        joints_(expected_joints(cell)) {}

  Verdict run() {
    verdict_.left = voxels_.stock;
    if (header_fits()) {
      replay_keyframes();
    } else {
      while (reader_.next()) watch_.step(Stage::verify, 0, 1);  // text that is no trajectory is still refused as such
    }
    verdict_.clean = verdict_.collisions == 0;
    return std::move(verdict_);
  }

 private:
  const TrajectoryHeader& header() const { return reader_.header(); }

  void find(std::string sentence) {
    ++verdict_.collisions;
    if (verdict_.findings.size() < listed_findings) verdict_.findings.push_back({reader_.line(), std::move(sentence)});
  }

  // False where a replay would mean nothing.
  bool header_fits() {
    std::vector<std::string> names;
    for (int joint : joints_) names.push_back(cell_.robot.joints[static_cast<std::size_t>(joint)].name);
    if (header().joints != names) find("the header's joints are not those between the cell's stock and tool links");
    if (header().grid.n != voxels_.n())
      find("the header's resolution is " + std::to_string(header().grid.n) + ", the material's " +
           std::to_string(voxels_.n()));
    if (verdict_.collisions > 0) return false;
    const Grid grid = cell_.grid(voxels_.n());
    if (std::abs(header().grid.voxel_m - grid.voxel_m) > length_slack_m ||
        (header().grid.origin_m - grid.origin_m).norm() > length_slack_m)
      find("the header's voxel size or origin is not the cell's");
    const Tool tool = make_tool(cell_.tool, grid.voxel_m);
    if (std::abs(header().tool.ball_radius_m - tool.ball_radius_m) > length_slack_m ||
        std::abs(header().tool.shank_radius_m - tool.shank_radius_m) > length_slack_m ||
        std::abs(header().tool.stickout_m - tool.stickout_m) > length_slack_m)
      find("the header's tool is not the cell's");
    if (header().tolerance_m > largest_tolerance_voxels * grid.voxel_m + length_slack_m)
      find("the header's tolerance is " + text(header().tolerance_m / grid.voxel_m) + " voxels, more than " +
           text(largest_tolerance_voxels));
    for (std::size_t at = 0; at < joints_.size(); ++at)
      if (std::abs(header().home[static_cast<Eigen::Index>(at)] - cell_.rest[static_cast<std::size_t>(joints_[at])]) >
          home_slack)
        find("the header's home of joint " + header().joints[at] + " is not the cell's");
    return true;
  }

  bool within_limits(const Configuration& q) const {
    for (std::size_t at = 0; at < joints_.size(); ++at) {
      const Joint& joint = cell_.robot.joints[static_cast<std::size_t>(joints_[at])];
      const double value = q[static_cast<Eigen::Index>(at)];
      if (value < joint.lower - joint_slack || value > joint.upper + joint_slack) return false;
    }
    return true;
  }

  void find_broken_limits(const Configuration& q) {
    for (std::size_t at = 0; at < joints_.size(); ++at) {
      const Joint& joint = cell_.robot.joints[static_cast<std::size_t>(joints_[at])];
      const double value = q[static_cast<Eigen::Index>(at)];
      if (value < joint.lower - joint_slack || value > joint.upper + joint_slack)
        find("joint " + joint.name + " at " + text(value) + " is outside its limits " + text(joint.lower) + " to " +
             text(joint.upper));
    }
  }

  void replay_keyframes() {
    const Grid grid = cell_.grid(voxels_.n());
    const double voxel_mm = 1000 * grid.voxel_m;
    const LinkMotion motion(cell_.robot, joints_, cell_.rest, cell_.stock_link);
    const std::vector<SolidBody> bodies = make_solid_bodies(cell_.robot);
    StandingVoxels material(voxels_.stock, voxel_mm);
    ToolReplay tool(cell_, make_tool(cell_.tool, grid.voxel_m), motion, bodies, material, voxel_mm);
    LinkReplay links(cell_, motion, bodies, material, voxel_mm);

    find_broken_limits(header().home);
    Configuration from = header().home;
    while (const auto keyframe = reader_.next()) {
      find_broken_limits(keyframe->q);
      replay_motion({from, keyframe->q - from}, *keyframe, tool, links, material);
      from = keyframe->q;
    }
    if ((from - header().home).cwiseAbs().maxCoeff() > joint_slack) find("the last keyframe is not home");
    verdict_.left = material.voxels();
  }

  void replay_motion(const JointMotion& whole, const Keyframe& keyframe, ToolReplay& tool, LinkReplay& links,
                     StandingVoxels& material) {
    // Out of its limits a joint can be anywhere: the finding is made, and a replay could take for ever.
    const bool possible = within_limits(whole.from) && within_limits(keyframe.q);
    const int parts = std::max(1, run_length(keyframe));
    for (int part = 0; part < parts; ++part) {
      watch_.step(Stage::verify, reader_.line() - 2, std::max(lines_, reader_.line()) - 1);
      const double begin = static_cast<double>(part) / parts, end = static_cast<double>(part + 1) / parts;
      const JointMotion motion{whole.at(begin), whole.at(end) - whole.at(begin)};
      const auto on_contact = [&](const std::string& what, double t) {
        find(what + " at " + text(100 * (begin + t * (end - begin))) + " % of the motion to this keyframe");
      };
      if (possible)
        links.replay(motion, on_contact);  // links may not even touch the voxel that the tool is about to cut
      if (keyframe.cut) remove_voxel(keyframe, part, whole.at(end), tool, material);
      if (possible) tool.replay(motion, on_contact);
    }
  }

  void remove_voxel(const Keyframe& keyframe, int part, const Configuration& q, const ToolReplay& tool,
                    StandingVoxels& material) {
    const Voxel run = keyframe.last - keyframe.first;
    const auto sign = [](int value) { return (value > 0) - (value < 0); };
    const Voxel voxel = keyframe.first + Voxel{sign(run.i), sign(run.j), sign(run.k)} * part;
    ++verdict_.voxels_checked;
    const double miss_m = (tool.ball_at(q) / 1000 - cell_.grid(voxels_.n()).centre(voxel)).norm();
    if (!(miss_m <= header().tolerance_m + joint_slack))
      find("the ball is " + text(miss_m / header().grid.voxel_m) + " voxels from the centre of voxel " + text(voxel) +
           " that it removes");
    switch (voxels_.label(voxel)) {
      case Label::air:
        find("voxel " + text(voxel) + " is removed but was air from the start");
        break;
      case Label::keep:
        find("voxel " + text(voxel) + " is removed but belongs to the target");
        break;
      case Label::remove:
        if (!material.contains(voxel)) find("voxel " + text(voxel) + " is removed a second time");
    }
    material.remove(voxel);
  }

  const Cell& cell_;
  const VoxelGrid& voxels_;
  const Watch& watch_;
  std::uint64_t lines_;
  TrajectoryReader reader_;
  std::vector<int> joints_;
  Verdict verdict_;
};

}  // namespace

Verdict verify_trajectory(std::istream& in, const Cell& cell, const VoxelGrid& voxels, const Watch& watch) {
  return Replay(in, cell, voxels, watch).run();
}

}  // namespace sculpt
