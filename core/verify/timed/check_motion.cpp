#include "core/verify/timed/check_motion.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <optional>
#include <sstream>

#include "core/base/error.hpp"
#include "core/verify/findings/finding_text.hpp"
#include "core/verify/findings/slack.hpp"
#include "core/verify/timed/law_replay.hpp"
#include "core/verify/timed/path_beside.hpp"

namespace sculpt {
namespace {

constexpr std::size_t max_findings = 100;
constexpr double limit_slack = 1e-9;    // of a limit, for double arithmetic
constexpr double sampled_slack = 1e-6;  // of differences over a thousandth of a second
constexpr double quantum_m = 3e-7;      // of tips as the file has them, and of the planner's posture

struct MotionLimits {
  Configuration velocity, acceleration, jerk;
};

MotionLimits read_motion_limits(const Cell& cell, const std::vector<std::string>& joints) {
  const auto size = static_cast<Eigen::Index>(joints.size());
  MotionLimits limits{Configuration(size), Configuration(size), Configuration(size)};
  for (Eigen::Index at = 0; at < size; ++at) {
    const std::string& name = joints[static_cast<std::size_t>(at)];
    const int joint = cell.robot.find_joint(name);
    if (joint < 0) throw InputError("cell_mismatch", "the cell has no joint '" + name + "' that the plan moves");
    const JointLimits& own = cell.limits[static_cast<std::size_t>(joint)];
    if (!(own.velocity > 0 && own.acceleration > 0 && own.jerk > 0))
      throw InputError("limits_missing", "joint '" + name + "' has no limits in the cell file: give it \"limits\"");
    limits.velocity[at] = own.velocity;
    limits.acceleration[at] = own.acceleration;
    limits.jerk[at] = own.jerk;
  }
  return limits;
}

/// The mean of the motion over a window of time, as pieces come.
class Window {
 public:
  struct State {
    Configuration q, velocity, acceleration;
    double gone = 0;   ///< r
    bool cuts = true;  ///< all along the window
  };

  Window(LawReplay& replay, Configuration home, std::function<void(const TimePolynomial&)> seen)
      : replay_(replay), home_(std::move(home)), seen_(std::move(seen)) {}

  /// Holds what it takes for windows from the one time to the other, and no window before. Where the motion ends, it is
  /// as if it stood.
  void hold(double from_s, double to_s) {
    while (!ended_ && (pieces_.empty() || pieces_.back().end_s() < to_s)) {
      if (auto piece = replay_.next()) {
        seen_(*piece);
        pieces_.push_back(std::move(*piece));
      } else {
        ended_ = true;
      }
    }
    while (pieces_.size() > 1 && pieces_.front().end_s() < from_s) pieces_.pop_front();
  }
  bool is_over(double time_s) const { return ended_ && (pieces_.empty() || time_s > pieces_.back().end_s()); }
  double end_s() const { return pieces_.empty() ? 0 : pieces_.back().end_s(); }

  State mean(double from_s, double to_s) const {
    State state{home_ * std::max(0.0, -from_s), {}, {}};
    bool moves = false;
    for (const TimePolynomial& piece : pieces_) {
      const double begin = std::max(from_s, piece.begin_s) - piece.begin_s,
                   end = std::min(to_s, piece.end_s()) - piece.begin_s;
      if (end <= begin) continue;
      state.q += piece.integral(end) - piece.integral(begin);
      state.gone += piece.gone_integral(end) - piece.gone_integral(begin);
      state.cuts = state.cuts && piece.cut;
      moves = true;
    }
    state.cuts = state.cuts && moves;
    const TimePolynomial& last = pieces_.back();
    if (const double rest = to_s - std::max(from_s, last.end_s()); rest > 0) {
      state.q += last.place(last.seconds) * rest;
      state.gone += (last.gone + last.seconds * (last.speed + last.seconds * last.rise / 2)) * rest;
    }
    const double window = to_s - from_s;
    state.q /= window;
    state.gone /= window;
    const auto [q0, v0] = at(from_s);
    const auto [q1, v1] = at(to_s);
    state.velocity = (q1 - q0) / window;
    state.acceleration = (v1 - v0) / window;
    return state;
  }

 private:
  std::pair<Configuration, Configuration> at(double time_s) const {
    const Configuration still = Configuration::Zero(home_.size());
    if (time_s <= 0) return {home_, still};
    for (const TimePolynomial& piece : pieces_)
      if (time_s <= piece.end_s()) return {piece.place(time_s - piece.begin_s), piece.velocity(time_s - piece.begin_s)};
    return {pieces_.back().place(pieces_.back().seconds), still};
  }

  LawReplay& replay_;
  Configuration home_;
  std::function<void(const TimePolynomial&)> seen_;
  std::deque<TimePolynomial> pieces_;
  bool ended_ = false;
};

class Checker {
 public:
  Checker(std::istream& plan, const LawFile& law, const Cell& cell, const Watch& watch, const MotionCheck& check)
      : reader_(plan),
        law_(law),
        watch_(watch),
        check_(check),
        limits_(read_motion_limits(cell, reader_.header().joints)),
        replay_(reader_, law,
                [this](std::uint64_t keyframe, std::string sentence) { find(keyframe, std::move(sentence)); }),
        beside_(cell, reader_.header(), replay_) {}

  MotionVerdict run() {
    const double step = 1 / check_.samples_hz, window = law_.law.window_s;
    Window motion(replay_, reader_.header().home, [this](const TimePolynomial& piece) { look_at(piece); });
    if (!(window > 0)) {
      find(0, "the law has no window to average over: its jerk has no bound");
      return std::move(verdict_);
    }
    motion.hold(0, window);
    std::optional<Window::State> before;
    for (double time = 0; motion.end_s() > 0; time = static_cast<double>(++verdict_.samples) * step) {
      motion.hold(time - window, time);
      const Window::State now = motion.mean(time - window, time);
      if (before) look_at_step(*before, now, step);
      look_beside(now);
      before = now;
      if (verdict_.samples % 4096 == 0) watch_.step(Stage::verify, verdict_.samples, verdict_.samples + 1);
      if (motion.is_over(time - window)) break;
    }
    verdict_.total_s = motion.end_s() + window;
    return std::move(verdict_);
  }

 private:
  void find(std::uint64_t keyframe, std::string sentence) {
    if (verdict_.faults++ < max_findings) verdict_.findings.push_back({keyframe, std::move(sentence)});
  }
  const std::string& joint(Eigen::Index at) const { return reader_.header().joints[static_cast<std::size_t>(at)]; }

  /// The largest share of a limit; finds each joint that exceeds it.
  double share(const Configuration& most, const Configuration& limit, double allowed, std::uint64_t keyframe,
               const char* what) {
    double largest = 0;
    for (Eigen::Index at = 0; at < most.size(); ++at) {
      const double part = std::abs(most[at]) / limit[at];
      largest = std::max(largest, part);
      if (!(part <= 1 + allowed))
        find(keyframe, std::string(what) + " of joint '" + joint(at) + "' is " + text(std::abs(most[at])) +
                           ", its limit is " + text(limit[at]));
    }
    return largest;
  }

  void look_at(const TimePolynomial& piece) {
    ++verdict_.pieces;
    const Configuration acceleration = piece.max_acceleration();
    verdict_.velocity = std::max(
        verdict_.velocity, share(piece.max_velocity(), limits_.velocity, limit_slack, piece.keyframe, "velocity"));
    verdict_.acceleration = std::max(
        verdict_.acceleration, share(acceleration, limits_.acceleration, limit_slack, piece.keyframe, "acceleration"));
    verdict_.jerk = std::max(
        verdict_.jerk, share(2 / law_.law.window_s * acceleration, limits_.jerk, limit_slack, piece.keyframe, "jerk"));
    if (end_ && (piece.place(0) - *end_).cwiseAbs().maxCoeff() > 1e-7)
      find(piece.keyframe, "the motion jumps on the way to it");
    end_ = piece.place(piece.seconds);
  }

  void look_at_step(const Window::State& before, const Window::State& now, double step) {
    const std::uint64_t keyframe = beside_.keyframe();
    share((now.q - before.q) / step, limits_.velocity, sampled_slack, keyframe, "sampled velocity");
    share((now.velocity - before.velocity) / step, limits_.acceleration, sampled_slack, keyframe,
          "sampled acceleration");
    share((now.acceleration - before.acceleration) / step, limits_.jerk, sampled_slack, keyframe, "sampled jerk");
  }

  void look_beside(const Window::State& now) {
    const PathBeside::Off off = beside_.off(now.q, now.gone, mm * std::min(verdict_.links_m, check_.max_links_m));
    const double voxels = off.ball / (mm * reader_.header().grid.voxel_m),
                 speed = before_ ? (beside_.ball(now.q) - beside_.ball(*before_)).norm() / mm * check_.samples_hz : 0;
    const bool cuts = now.cuts && cut_before_;
    const MillTool* milling = beside_.milling();
    const double feed = milling ? std::min(law_.law.feed_m_s, milling->feed_m_s) : law_.law.feed_m_s;
    double& fastest = cuts ? verdict_.feed_m_s : verdict_.rapid_m_s;
    fastest = std::max(fastest, speed);
    const double most = cuts ? feed : std::max(feed, law_.law.rapid_m_s);
    if (!(speed <= most * (1 + sampled_slack)))
      find(beside_.keyframe(), std::string("the ball moves at ") + text(speed) + " m/s, more than the " +
                                   (cuts ? "feed" : "rapid rate") + " of " + text(most));
    before_ = now.q;
    cut_before_ = now.cuts;
    verdict_.links_m = std::max(verdict_.links_m, off.links / mm);
    if (off.links / mm > check_.max_links_m)
      find(beside_.keyframe(), "two links, or one and the stock, may be " + text(1e3 * off.links) +
                                   " um nearer to each other than on the path");
    if (milling) {
      look_at_cutter(now, off);
      return;
    }
    if (!now.cuts) return;
    verdict_.ball_voxels = std::max(verdict_.ball_voxels, voxels);
    const double shank = off.shank / (mm * reader_.header().grid.voxel_m);
    verdict_.shank_voxels = std::max(verdict_.shank_voxels, shank);
    if (shank > check_.max_shank_voxels)
      find(beside_.keyframe(), "the shank's end is " + text(shank) + " voxels off the path");
    if (voxels > check_.max_ball_voxels)
      find(beside_.keyframe(), "the ball is " + text(voxels) + " voxels off the path");
  }

  void look_at_cutter(const Window::State& now, const PathBeside::Off& off) {
    if (!now.cuts) {
      if (off.ball / mm > check_.max_links_m)
        find(beside_.keyframe(), "the tip is " + text(1e3 * off.ball) + " um off the path of a move");
      return;
    }
    const double cutter_m = beside_.cutter_off(now.q) / mm;
    verdict_.cutter_m = std::max(verdict_.cutter_m, cutter_m);
    if (!(cutter_m <= reader_.header().mill->stray_m + quantum_m))
      find(beside_.keyframe(), "the cutter is " + text(1e6 * cutter_m) + " um off its straight way, the plan allows " +
                                   text(1e6 * reader_.header().mill->stray_m));
  }

  TrajectoryReader reader_;
  const LawFile& law_;
  const Watch& watch_;
  const MotionCheck check_;
  const MotionLimits limits_;
  MotionVerdict verdict_;
  LawReplay replay_;
  PathBeside beside_;
  std::optional<Configuration> end_;
  std::optional<Configuration> before_;
  bool cut_before_ = false;
};

}  // namespace

MotionVerdict check_motion(std::istream& plan, const LawFile& law, const Cell& cell, const Watch& watch,
                           const MotionCheck& check) {
  return Checker(plan, law, cell, watch, check).run();
}

}  // namespace sculpt
