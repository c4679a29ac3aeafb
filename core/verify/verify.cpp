#include "core/verify/verify.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <istream>
#include <map>
#include <mutex>
#include <optional>
#include <sstream>
#include <thread>

#include "core/trajectory/header.hpp"
#include "core/trajectory/reader.hpp"
#include "core/verify/findings/finding_text.hpp"
#include "core/verify/findings/slack.hpp"
#include "core/verify/home_contacts.hpp"
#include "core/verify/material/held_voxels.hpp"
#include "core/verify/piece_replay.hpp"
#include "core/verify/robot/urdf_differences.hpp"
#include "core/verify/trajectory_pieces.hpp"

namespace sculpt {
namespace {

constexpr double max_tolerance_voxels = 0.04;
constexpr double header_slack_m = 1e-12;

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

// Workers and what they find. The calling thread is one of them; it alone tells the watch.
class Crew {
 public:
  Crew(TrajectoryReader& reader, const ReplayScene& scene, const Watch& watch, const ReplaySettings& settings,
       ReplayedPieces done, const std::function<void(const ReplayedPieces&)>& note)
      : pieces_(reader),
        scene_(scene),
        watch_(watch),
        settings_(settings),
        to_remove_(scene.voxels.stock.size() - scene.voxels.keep.size()),
        removed_(done.found.voxels_checked),
        left_(scene.voxels.stock),
        note_(note),
        known_(done.pieces),
        replayed_(std::move(done)) {}

  void run() {
    for (std::size_t worker = 1; worker < threads(); ++worker)
      others_.emplace_back([this, worker] {
        if (wait_for_call()) work(worker, *called_with_);
      });
    work(0, scene_.voxels.stock);
    dismiss();
    others_.clear();
    if (failure_) std::rethrow_exception(failure_);
  }

  /// After `run`.
  PieceFindings& found() { return replayed_.found; }
  VoxelSet& left() { return left_; }
  const Configuration& end() const { return pieces_.end(); }
  const CutLog& cuts() const { return pieces_.cuts(); }

 private:
  void work(std::size_t worker, const VoxelSet& standing) {
    try {
      replay_pieces(worker, standing);
    } catch (...) {
      pieces_.abandon();
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
    }
  }

  void replay_pieces(std::size_t worker, const VoxelSet& standing) {
    std::optional<PieceReplay> replay;  // costs a material: made for a worker who gets to do something
    const std::function<void()> step = [this, worker] { tell(worker); };
    std::vector<TrajectoryPieces::Piece> before;
    for (;;) {
      if (worker == 0 && !called_with_ && !(settings_.alone && settings_.alone()))
        call_others(replay ? replay->left() : standing);
      const TrajectoryPieces::Piece piece = pieces_.next(worker, before, step);
      if (!piece && worker != 0) return;
      if (!replay) replay.emplace(scene_, standing);
      for (const auto& missed : before) replay->skip(*missed);
      if (!piece) break;
      if (piece->index < known_) {
        replay->skip(*piece);
        continue;
      }
      PieceFindings found = replay->replay(*piece, step);
      removed_ += found.voxels_checked;
      add(piece->index, std::move(found));
    }
    left_ = replay->left();
  }

  // They begin where the calling thread is, which was alone until now.
  void call_others(VoxelSet standing) {
    pieces_.join(threads() - 1);
    {
      const std::lock_guard lock(mutex_);
      called_with_ = std::move(standing);
    }
    called_.notify_all();
  }

  void dismiss() {
    {
      const std::lock_guard lock(mutex_);
      dismissed_ = true;
    }
    called_.notify_all();
  }

  bool wait_for_call() {
    std::unique_lock lock(mutex_);
    called_.wait(lock, [this] { return called_with_ || dismissed_; });
    return called_with_.has_value();
  }

  std::size_t threads() const { return static_cast<std::size_t>(std::max(1, settings_.threads)); }

  void tell(std::size_t worker) {
    if (watch_.stop.stop_requested()) throw Cancelled{};
    if (worker == 0) watch_.step(Stage::verify, std::min<std::uint64_t>(removed_, to_remove_), to_remove_);
  }

  // In the order of the trajectory, whoever is first.
  void add(std::size_t index, PieceFindings found) {
    const std::lock_guard lock(mutex_);
    early_.emplace(index, std::move(found));
    for (; !early_.empty() && early_.begin()->first == replayed_.pieces; early_.erase(early_.begin())) {
      replayed_.found.add(std::move(early_.begin()->second));
      ++replayed_.pieces;
      if (note_) note_(replayed_);
    }
  }

  TrajectoryPieces pieces_;
  const ReplayScene& scene_;
  const Watch& watch_;
  const ReplaySettings& settings_;
  const std::uint64_t to_remove_;
  std::atomic<std::uint64_t> removed_ = 0;
  VoxelSet left_;  // the calling thread's
  const std::function<void(const ReplayedPieces&)>& note_;
  const std::uint64_t known_;  // pieces that were replayed before
  std::mutex mutex_;           // of what follows
  std::exception_ptr failure_;
  std::map<std::size_t, PieceFindings> early_;
  ReplayedPieces replayed_;
  std::condition_variable called_;
  std::optional<VoxelSet> called_with_;  // what stood when the others were called; stays as it is
  bool dismissed_ = false;
  std::vector<std::jthread> others_;  // last: they use all else
};

class Replay {
 public:
  Replay(std::istream& in, const Cell& cell, const VoxelGrid& voxels, const Watch& watch, ReplaySettings settings,
         ReplayedPieces done, const std::function<void(const ReplayedPieces&)>& note)
      : cell_(cell),
        voxels_(voxels),
        watch_(watch),
        settings_(std::move(settings)),
        done_(std::move(done)),
        note_(note),
        reader_(in),
        joints_(expected_joints(cell)) {}

  Verdict run() {
    verdict_.left = voxels_.stock;
    if (header_fits()) {
      replay_keyframes();
    } else {
      while (reader_.next()) watch_.step(Stage::verify, 0, 1);  // text that is no trajectory is still refused as such
    }
    verdict_.collisions = found_.collisions;
    verdict_.voxels_checked = found_.voxels_checked;
    verdict_.findings = std::move(found_.findings);
    verdict_.clean = verdict_.collisions == 0;
    return std::move(verdict_);
  }

 private:
  const TrajectoryHeader& header() const { return reader_.header(); }

  void find(std::string sentence) { found_.find(reader_.line(), std::move(sentence)); }

  // False where a replay would mean nothing.
  bool header_fits() {
    for (const std::string& difference : urdf_differences(cell_)) find(difference);
    std::vector<std::string> names;
    for (int joint : joints_) names.push_back(cell_.robot.joints[static_cast<std::size_t>(joint)].name);
    if (header().joints != names) find("the header's joints are not those between the cell's stock and tool links");
    if (header().grid.n != voxels_.n())
      find("the header's resolution is " + std::to_string(header().grid.n) + ", the material's " +
           std::to_string(voxels_.n()));
    if (header().joints != names || header().grid.n != voxels_.n()) return false;
    const Grid grid = cell_.grid(voxels_.n());
    if (std::abs(header().grid.voxel_m - grid.voxel_m) > header_slack_m ||
        (header().grid.origin_m - grid.origin_m).norm() > header_slack_m)
      find("the header's voxel size or origin is not the cell's");
    const Tool tool = make_tool(cell_.tool, grid.voxel_m);
    if (std::abs(header().tool.ball_radius_m - tool.ball_radius_m) > header_slack_m ||
        std::abs(header().tool.shank_radius_m - tool.shank_radius_m) > header_slack_m ||
        std::abs(header().tool.stickout_m - tool.stickout_m) > header_slack_m)
      find("the header's tool is not the cell's");
    if (header().tolerance_m > max_tolerance_voxels * grid.voxel_m + header_slack_m)
      find("the header's tolerance is " + text(header().tolerance_m / grid.voxel_m) + " voxels, more than " +
           text(max_tolerance_voxels));
    for (std::size_t at = 0; at < joints_.size(); ++at)
      if (std::abs(header().home[static_cast<Eigen::Index>(at)] - cell_.rest[static_cast<std::size_t>(joints_[at])]) >
          home_slack)
        find("the header's home of joint " + header().joints[at] + " is not the cell's");
    return true;
  }

  void replay_keyframes() {
    const ReplayScene scene(cell_, voxels_, header(), joints_, settings_.thorough);
    verdict_.exempt_pairs = scene.pairs.exempt;
    for (const LinkPair& contact : scene.pairs.contacts) find(describe_home_contact(cell_.robot, contact));
    find_broken_limits(scene, header().home, reader_.line(), found_);
    Crew crew(reader_, scene, watch_, settings_, std::move(done_), note_);
    crew.run();
    found_.add(std::move(crew.found()));
    verdict_.left = std::move(crew.left());
    find_freed_pieces(crew.cuts());
    if ((crew.end() - header().home).cwiseAbs().maxCoeff() > joint_slack) find("the last keyframe is not home");
  }

  // Of a plan that removes what does not stand nothing is said: it has findings enough.
  void find_freed_pieces(const CutLog& cuts) {
    if (!cuts.removes_each_once(voxels_.stock, verdict_.left)) return;
    const bool must_hold = header().held || std::any_of(joints_.begin(), joints_.end(), [&](int joint) {
                             return cell_.robot.joints[static_cast<std::size_t>(joint)].kind == JointKind::revolute;
                           });
    const auto step = [this] {
      if (watch_.stop.stop_requested()) throw Cancelled{};
    };
    for (const FreedPiece& piece : cuts.find_freed(voxels_.stock, find_never_held(voxels_), step)) {
      verdict_.freed += piece.voxels;
      if (must_hold && piece.unforeseen > 0)
        found_.find(piece.line, "voxel (" + std::to_string(piece.removed.i) + ", " + std::to_string(piece.removed.j) +
                                    ", " + std::to_string(piece.removed.k) + ") is removed, and " +
                                    std::to_string(piece.voxels) + " voxels that it held come loose");
    }
  }

  const Cell& cell_;
  const VoxelGrid& voxels_;
  const Watch& watch_;
  const ReplaySettings settings_;
  ReplayedPieces done_;
  const std::function<void(const ReplayedPieces&)>& note_;
  TrajectoryReader reader_;
  std::vector<int> joints_;
  PieceFindings found_;
  Verdict verdict_;
};

}  // namespace

Verdict verify_trajectory(std::istream& in, const Cell& cell, const VoxelGrid& voxels, const Watch& watch,
                          ReplaySettings settings, ReplayedPieces done,
                          const std::function<void(const ReplayedPieces&)>& note) {
  return Replay(in, cell, voxels, watch, std::move(settings), std::move(done), note).run();
}

}  // namespace sculpt
