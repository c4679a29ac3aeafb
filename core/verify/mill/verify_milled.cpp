#include "core/verify/mill/verify_milled.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <sstream>

#include "core/trajectory/reader.hpp"
#include "core/verify/findings/finding_text.hpp"
#include "core/verify/findings/slack.hpp"
#include "core/verify/home_contacts.hpp"
#include "core/verify/material/held_voxels.hpp"
#include "core/verify/mill/chip_scale.hpp"
#include "core/verify/mill/cutter_log.hpp"
#include "core/verify/mill/cutter_sweep.hpp"
#include "core/verify/mill/surface_judge.hpp"
#include "core/verify/mill/tool_scene.hpp"
#include "core/verify/robot/urdf_differences.hpp"

namespace sculpt {
namespace {

constexpr double length_slack_m = 1e-9;
/// A tip may be that far from where its keyframe says (mm), an axis turned by so much (rad): joints are rounded.
constexpr double tip_slack_mm = 1e-3, axis_slack = 1e-5;
constexpr double level_mm = 1e-3;

class MilledReplay {
 public:
  MilledReplay(std::istream& in, const Cell& cell, const VoxelGrid& voxels, const MilledPart& part, int threads,
               const Watch& watch)
      : cell_(cell),
        voxels_(voxels),
        part_(part),
        watch_(watch),
        reader_(in),
        grid_(cell.grid(voxels.n())),
        surface_(part.mesh, voxels, grid_, threads),
        to_remove_(voxels.stock.size() - voxels.keep.size()),
        left_(voxels.stock),
        cubes_(voxels.stock),
        material_(voxels.stock, 1000 * grid_.voxel_m, false),
        log_(voxels.n(), 1000 * grid_.voxel_m) {}

  Verdict run() {
    if (!header().mill)
      throw InputError("trajectory_invalid", "the trajectory has no milling tools: it is replayed otherwise");
    const bool fits = header_fits();
    std::vector<Keyframe> piece;
    at_ = header().home;
    while (auto keyframe = reader_.next()) {
      piece.push_back(std::move(*keyframe));
      if (piece.size() == keyframes_a_piece && fits) replay(std::exchange(piece, {}));
      watch_.step(Stage::verify, removed_, to_remove_);
    }
    if (fits) {
      if (!piece.empty()) replay(std::move(piece));
      if ((at_ - header().home).cwiseAbs().maxCoeff() > joint_slack) find("the last keyframe is not home");
    }
    found_.add(surface_.finish());
    find_freed_chunks();
    std::ranges::stable_sort(found_.findings, {}, &Finding::line);
    verdict_.surface = surface_.verdict(cubes_);
    if (const SurfaceVerdict& surface = *verdict_.surface; surface.gouged_points > 0)
      find("points of the part are cut below the surface, by up to " + text(1000 * surface.gouge_m) + " mm");
    verdict_.left = left_;
    verdict_.collisions = found_.collisions;
    verdict_.voxels_checked = removed_;
    verdict_.findings = std::move(found_.findings);
    verdict_.clean = verdict_.collisions == 0;
    return std::move(verdict_);
  }

 private:
  static constexpr std::size_t keyframes_a_piece = 512;

  const TrajectoryHeader& header() const { return reader_.header(); }
  const MillHeader& mill() const { return *header().mill; }
  void find(std::string sentence) { found_.find(line_, std::move(sentence)); }

  void find_freed_chunks() {
    const auto step = [this] {
      if (watch_.stop.stop_requested()) throw Cancelled{};
    };
    for (const FreedChunk& chunk : log_.find_freed(left_, find_never_held(voxels_), step)) {
      verdict_.freed += chunk.voxels;
      found_.find(chunk.line, "a piece of " + std::to_string(chunk.voxels) + " voxels, more than a chip, comes loose");
    }
  }

  bool header_fits() {
    for (const std::string& difference : urdf_differences(cell_)) find(difference);
    for (int joint : LinkMotion::path(cell_.robot, cell_.stock_link, cell_.tool_link)) {
      while (cell_.robot.joints[static_cast<std::size_t>(joint)].mimic >= 0)
        joint = cell_.robot.joints[static_cast<std::size_t>(joint)].mimic;
      if (cell_.robot.joints[static_cast<std::size_t>(joint)].kind == JointKind::fixed) continue;
      if (std::ranges::find(joints_, joint) == joints_.end()) joints_.push_back(joint);
    }
    std::vector<std::string> names;
    for (const int joint : joints_) names.push_back(cell_.robot.joints[static_cast<std::size_t>(joint)].name);
    if (header().joints != names || header().grid.n != voxels_.n()) {
      find("the header's joints or resolution are not those of the cell and the material");
      return false;
    }
    if (std::abs(header().grid.voxel_m - grid_.voxel_m) > length_slack_m ||
        (header().grid.origin_m - grid_.origin_m).norm() > length_slack_m)
      find("the header's voxel size or origin is not the cell's");
    if (mill().mesh_sha256 != part_.mesh_sha256) find("the header names another mesh file");
    for (std::size_t at = 0; at < joints_.size(); ++at)
      if (std::abs(header().home[static_cast<Eigen::Index>(at)] - cell_.rest[static_cast<std::size_t>(joints_[at])]) >
          home_slack)
        find("the header's home of joint " + header().joints[at] + " is not the cell's");
    take_tool(0);
    verdict_.exempt_pairs = scene_->whole_pairs.exempt;
    for (const LinkPair& contact : scene_->whole_pairs.contacts)
      find(describe_home_contact(scene_->cell.robot, contact));
    return true;
  }

  void take_tool(int number) {
    scene_ = std::make_unique<ToolScene>(cell_, mill().tools[static_cast<std::size_t>(number)], joints_, material_);
    sweeps_.clear();
    chips_.end();
  }

  struct Sweeps {
    CutterSweep centres, cubes;
  };
  const Sweeps& sweeps(int direction) {
    auto& made = sweeps_[direction];
    if (!made) {
      const double more = std::numbers::sqrt3 / 2 * grid_.voxel_m;
      const auto& way = mill().directions[static_cast<std::size_t>(direction)];
      made = std::make_unique<Sweeps>(
          Sweeps{{scene_->tool.cutter, way, mill().stray_m}, {scene_->tool.cutter, way, mill().stray_m + more}});
    }
    return *made;
  }

  Vec3 axis_of(int direction) const {
    const auto& way = mill().directions[static_cast<std::size_t>(direction)];
    return Vec3(way[0], way[1], way[2]).normalized();
  }

  /// Up to each change of tools bodies are the same.
  void replay(std::vector<Keyframe> keyframes) {
    auto begin = keyframes.begin();
    while (begin != keyframes.end()) {
      const auto change = std::find_if(begin, keyframes.end(), [](const Keyframe& k) { return k.mill->is_change(); });
      if (change != begin) replay_piece({0, line_ + 1, at_, {begin, change}});
      found_.add(surface_.take(std::exchange(ways_, {})));
      if (change == keyframes.end()) return;
      ++line_;
      change_tool(*change);
      begin = change + 1;
    }
  }

  void change_tool(const Keyframe& keyframe) {
    if ((keyframe.q - at_).cwiseAbs().maxCoeff() > joint_slack) find("the tool is changed while the robot moves");
    take_tool(keyframe.mill->tool);
    // The new one where it is put in, as a motion of no length.
    const TrajectoryPiece piece{0, line_, at_, {keyframe}};
    scene_->whole->look_ahead(piece, false);
    scene_->whole->replay(0, JointMotion(at_, at_),
                          [&](const std::string& what, double) { find("when the tool is changed, " + what); });
    tip_.reset();
  }

  bool within_limits(const Configuration& q) const {
    for (std::size_t at = 0; at < joints_.size(); ++at) {
      const Joint& joint = cell_.robot.joints[static_cast<std::size_t>(joints_[at])];
      const double value = q[static_cast<Eigen::Index>(at)];
      if (value < joint.lower - joint_slack || value > joint.upper + joint_slack) return false;
    }
    return true;
  }

  void replay_piece(const TrajectoryPiece& piece) {
    const bool possible = within_limits(piece.from) &&
                          std::ranges::all_of(piece.keyframes, [&](const Keyframe& k) { return within_limits(k.q); });
    scene_->links->look_ahead(piece, possible);
    scene_->whole->look_ahead(piece, possible);
    for (std::size_t index = 0; index < piece.keyframes.size(); ++index) {
      ++line_;
      const Keyframe& keyframe = piece.keyframes[index];
      if (within_limits(keyframe.q)) {
        replay_keyframe(index, keyframe);
      } else {
        find("a joint is outside its limits");
      }
      at_ = keyframe.q;
      if (watch_.stop.stop_requested()) throw Cancelled{};
    }
  }

  void replay_keyframe(std::size_t index, const Keyframe& keyframe) {
    const MillStep& step = *keyframe.mill;
    const JointMotion motion(at_, keyframe.q);
    LinkChain::Place from, to;
    scene_->chain.place(at_, from);
    scene_->chain.place(keyframe.q, to);
    if (step.is_placed()) check_place(step, to);
    const bool straight = step.is_placed() && tip_ && tip_->direction == step.direction;
    if (keyframe.cut && !straight) find("a cut does not begin where a tip was given in the same direction");
    // What holds the cutter is held against the material as before the cut: it may not follow where the cutter is yet
    // to come.
    LinkReplay& bodies = keyframe.cut ? *scene_->links : *scene_->whole;
    bodies.replay(index, motion, [&](const std::string& what, double t) {
      find(what + " at " + text(100 * t) + " % of the motion to this keyframe");
    });
    if (keyframe.cut && straight) cut(step, motion, from, to);
    if (!keyframe.cut) chips_.end();
    tip_.reset();
    if (step.is_placed()) tip_ = step;
  }

  void check_place(const MillStep& step, const LinkChain::Place& place) {
    Vec3 stated;
    for (std::size_t axis = 0; axis < 3; ++axis)
      stated[static_cast<int>(axis)] = static_cast<double>(step.tip[axis]) * 1e-4;
    if (const double off = (scene_->tip(place) - stated).norm(); !(off <= tip_slack_mm))
      find("the tip is " + text(off) + " mm from where the keyframe says");
    if (const double off = (ToolScene::axis(place) - axis_of(step.direction)).norm(); !(off <= axis_slack))
      find("the tool's axis is turned by " + text(off) + " rad from its direction");
  }

  void cut(const MillStep& step, const JointMotion& motion, const LinkChain::Place& from, const LinkChain::Place& to) {
    const Cutter& cutter = scene_->tool.cutter;
    const double r = 1000 * cutter.radius_m, top = 1000 * (scene_->tool.stickout_m - cutter.flute_m),
                 bottom = 1000 * scene_->tool.stickout_m;
    // How far a point strays from the straight is convex in the point: the corners of a box around the cutter bound it.
    double stray = 0;
    for (const auto& [x, y] : {std::pair{r, r}, {r, -r}, {-r, r}, {-r, -r}})
      stray = std::max(stray, scene_->chain.sagitta(from, to, motion.step, {x, y, bottom}, {x, y, top}));
    stray += tip_slack_mm;
    if (stray > 1000 * mill().stray_m + tip_slack_mm)
      find("the cutter strays by up to " + text(stray) + " mm from the straight way, more than the header's " +
           text(1000 * mill().stray_m) + " mm");
    const Vec3 axis = axis_of(step.direction), a = scene_->tip(from), b = scene_->tip(to);
    ways_.push_back({line_, cutter, axis, a, b, stray});
    const Sweeps& swept = sweeps(step.direction);
    gone_.clear();
    const std::uint64_t removed = swept.centres.take(left_, grid_, tip_->tip, step.tip, &gone_);
    log_.add(line_, scene_->tool, gone_);
    if (removed != step.removed)
      find("the cut removes " + std::to_string(removed) + " voxels, not " + std::to_string(step.removed));
    removed_ += removed;
    gone_.clear();
    swept.cubes.take(cubes_, grid_, tip_->tip, step.tip, &gone_);
    for (const Voxel v : gone_) material_.remove(v);
    const bool level = std::abs((b - a).dot(axis)) < level_mm;
    if (!level) return chips_.end();
    if (const std::string heavy = chips_.weigh(scene_->tool, removed, 1000 * grid_.voxel_m, (b - a).norm());
        !heavy.empty())
      find(heavy);
  }

  const Cell& cell_;
  const VoxelGrid& voxels_;
  const MilledPart& part_;
  const Watch& watch_;
  TrajectoryReader reader_;
  Grid grid_;
  SurfaceJudge surface_;
  std::uint64_t to_remove_;
  VoxelSet left_, cubes_;
  StandingVoxels material_;
  CutterLog log_;
  std::vector<int> joints_;
  std::unique_ptr<ToolScene> scene_;
  std::map<int, std::unique_ptr<Sweeps>> sweeps_;
  Configuration at_;
  std::vector<CutterWay> ways_;
  std::optional<MillStep> tip_;  ///< of the keyframe before
  std::vector<Voxel> gone_;
  ChipScale chips_;
  std::uint64_t removed_ = 0, line_ = 1;
  PieceFindings found_;
  Verdict verdict_;
};

}  // namespace

Verdict verify_milled(std::istream& in, const Cell& cell, const VoxelGrid& voxels, const MilledPart& part, int threads,
                      const Watch& watch) {
  return MilledReplay(in, cell, voxels, part, threads, watch).run();
}

}  // namespace sculpt
