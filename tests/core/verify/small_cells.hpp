// Tiny cells in code for the tests of this folder, and trajectories written by plain loops.
#pragma once

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/random.hpp"
#include "core/trajectory/header.hpp"
#include "core/trajectory/keyframe.hpp"
#include "core/trajectory/quantum.hpp"
#include "core/trajectory/writer.hpp"
#include "core/verify/verify.hpp"

namespace sculpt {

inline Shape box_shape(const Vec3& centre, const Vec3& sides) {
  Shape shape;
  shape.kind = ShapeKind::box;
  shape.pose.translation() = centre;
  shape.sides_m = sides;
  return shape;
}

/// Adds a link below `parent` (-1: the root) and returns its index; `joint` is filled in and added too.
inline int add_link(Robot& robot, const std::string& name, int parent, Joint joint = {}) {
  const int link = static_cast<int>(robot.links.size());
  robot.links.push_back({name, {}, -1});
  if (parent < 0) return link;
  robot.links.back().parent_joint = static_cast<int>(robot.joints.size());
  if (joint.name.empty()) joint.name = name + "_joint";
  joint.parent_link = parent;
  joint.child_link = link;
  robot.joints.push_back(joint);
  return link;
}

inline Joint slide(const std::string& name, const Vec3& axis, double lower, double upper) {
  Joint joint;
  joint.name = name;
  joint.kind = JointKind::prismatic;
  joint.axis = axis;
  joint.lower = lower;
  joint.upper = upper;
  return joint;
}

inline Joint hinge(const std::string& name, const Vec3& origin, const Vec3& axis = Vec3::UnitZ()) {
  Joint joint;
  joint.name = name;
  joint.kind = JointKind::revolute;
  joint.origin.translation() = origin;
  joint.axis = axis;
  joint.lower = -3;
  joint.upper = 3;
  return joint;
}

constexpr double gantry_side_m = 0.08;
constexpr double gantry_stickout_m = 0.12;

/// Three slides over a table of 8 cm; the joints are the ball's place in the stock frame. A spindle of 4 cm sits above
/// the shank, a column on the x slide stands 10 cm behind the middle of the y travel.
inline Cell gantry_cell() {
  Cell cell;
  cell.name = "small-gantry";
  const int world = add_link(cell.robot, "table", -1);
  cell.robot.links[0].shapes.push_back(box_shape(Vec3(0.04, 0.04, -0.05), Vec3(0.4, 0.4, 0.1)));
  const int x = add_link(cell.robot, "bridge", world, slide("x", Vec3::UnitX(), -0.1, 0.2));
  cell.robot.links.back().shapes.push_back(box_shape(Vec3(0, 0.3, 0.15), Vec3(0.02, 0.02, 0.3)));
  const int y = add_link(cell.robot, "carriage", x, slide("y", Vec3::UnitY(), -0.1, 0.4));
  Joint z = slide("z", -Vec3::UnitZ(), -0.01, 0.3);
  z.origin.linear() = Eigen::AngleAxisd(EIGEN_PI, Vec3::UnitX()).toRotationMatrix();
  z.origin.translation() = Vec3(0, 0, gantry_stickout_m);
  cell.tool_link = add_link(cell.robot, "spindle", y, z);
  cell.robot.links.back().shapes.push_back(box_shape(Vec3(0, 0, -0.02), Vec3(0.04, 0.04, 0.04)));
  cell.stock_link = world;
  cell.stock_size_m = gantry_side_m;
  cell.tool.stickout_m = gantry_stickout_m;
  cell.rest = {0, 0, 0.15};
  return cell;
}

/// Keyframes for `gantry_cell`, in voxel coordinates: `at` (1.5, 2.5, 3.5) is the centre of voxel (1, 2, 3).
class GantryProgram {
 public:
  explicit GantryProgram(const Cell& cell, int n) : grid_(cell.grid(n)) {
    header_.joints = {"x", "y", "z"};
    header_.home = Eigen::Vector3d(cell.rest[0], cell.rest[1], cell.rest[2]);
    header_.grid = grid_;
    header_.tool = make_tool(cell.tool, grid_.voxel_m);
    header_.tolerance_m = 0.02 * grid_.voxel_m;
    header_.cell = cell.name;
    header_.search = "test";
  }

  Configuration q(const Vec3& at) const { return rounded(grid_.origin_m + grid_.voxel_m * at); }
  void move(const Vec3& at) { keyframes.push_back({q(at), false, {}, {}}); }
  void cut(Voxel first, Voxel last) {
    keyframes.push_back({q(Vec3(last.i + 0.5, last.j + 0.5, last.k + 0.5)), true, first, last});
  }
  void go_home() { keyframes.push_back({header_.home, false, {}, {}}); }
  /// Down into a column from above, and up again.
  void plunge(int i, int j, int lowest) {
    move(Vec3(i + 0.5, j + 0.5, grid_.n + 0.5));
    cut({i, j, grid_.n - 1}, {i, j, lowest});
    move(Vec3(i + 0.5, j + 0.5, grid_.n + 0.5));
  }

  TrajectoryHeader& header() { return header_; }
  double voxel_m() const { return grid_.voxel_m; }
  std::string text() const {
    std::ostringstream out;
    TrajectoryWriter writer(out, header_);
    for (const Keyframe& keyframe : keyframes) writer.add(keyframe);
    writer.finish();
    return out.str();
  }

  std::vector<Keyframe> keyframes;

 private:
  Grid grid_;
  TrajectoryHeader header_;
};

inline Verdict verify_text(const std::string& text, const Cell& cell, const VoxelGrid& voxels) {
  std::istringstream in(text);
  return verify_trajectory(in, cell, voxels, {});
}

inline std::string sentences(const Verdict& verdict) {
  std::string all;
  for (const Finding& finding : verdict.findings)
    all += "line " + std::to_string(finding.line) + ": " + finding.sentence + "\n";
  return all;
}

/// True if some finding holds all of `words`.
inline bool found(const Verdict& verdict, const std::vector<std::string>& words) {
  for (const Finding& finding : verdict.findings) {
    bool all = true;
    for (const std::string& word : words) all = all && finding.sentence.find(word) != std::string::npos;
    if (all) return true;
  }
  return false;
}

/// A landscape: each column of a full block is kept up to a height of 1 to n - 1 voxels.
struct Landscape {
  VoxelGrid voxels;
  std::vector<std::vector<int>> height;
};

inline Landscape random_landscape(int n, Random& random) {
  Landscape land{{VoxelSet(n, true), VoxelSet(n)}, std::vector<std::vector<int>>(static_cast<std::size_t>(n))};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int height = 1 + static_cast<int>(random.next() % static_cast<std::uint64_t>(n - 1));
      land.height[static_cast<std::size_t>(i)].push_back(height);
      for (int k = 0; k < height; ++k) land.voxels.keep.insert({i, j, k});
    }
  return land;
}

inline GantryProgram carve_landscape(const Cell& cell, const Landscape& land) {
  const int n = land.voxels.n();
  GantryProgram program(cell, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      program.plunge(i, j, land.height[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]);
  program.go_home();
  return program;
}

// Smallest distance from the box [0,1]^3 at `voxel` to the ball or the upright shank with the ball at `at`, less the
// radius; voxel edges.
inline double upright_tool_gap(const Vec3& at, Voxel voxel) {
  const Vec3 low(voxel.i, voxel.j, voxel.k);
  const Vec3 off = (low - at).cwiseMax(at - low - Vec3::Ones()).cwiseMax(0);
  const double aside = off.head<2>().norm();
  return std::min(off.norm() - 0.45, std::max(aside - 0.4, at.z() - (voxel.k + 1)));
}

/// The smallest of these gaps over the standing voxels near the tool; 0.5 if there are none.
inline double min_upright_gap(const Vec3& at, const VoxelSet& standing) {
  double least = 0.5;
  const int n = standing.n(), i0 = static_cast<int>(std::floor(at.x())), j0 = static_cast<int>(std::floor(at.y()));
  for (int i = std::max(0, i0 - 1); i <= std::min(n - 1, i0 + 1); ++i)
    for (int j = std::max(0, j0 - 1); j <= std::min(n - 1, j0 + 1); ++j)
      for (int k = 0; k < n; ++k)
        if (standing.contains({i, j, k})) least = std::min(least, upright_tool_gap(at, {i, j, k}));
  return least;
}

}  // namespace sculpt
