#include "core/sweep/follow.hpp"

#include <algorithm>
#include <cmath>

#include "core/collision/motion_bound.hpp"

namespace sculpt {
namespace {

constexpr double margin = 0.005;     // voxel edges, to any material
constexpr double longest_edge = 64;  // voxel edges

/// A configuration and where it was meant to have the ball.
struct Stop {
  Vec3 cell;
  Configuration q;
  double ball_off = 0, top_off = 0;  ///< from where ball and shank's end should be (voxel edges)
};

class Follower {
 public:
  Follower(const PostureField& field, const Tool& tool, const Grid& grid)
      : field_(field),
        chain_(field.chain()),
        voxel_m_(grid.voxel_m),
        stray_(stray_of(tool, grid.voxel_m)),
        speed_(motion_bound(chain_, chain_.stock_link(), chain_.tool_link(), tool.stickout_m)),
        turn_rates_(chain_.turn_rates()) {}

  Followed run(const Vec3& from, const std::vector<Stroke>& strokes) {
    Followed followed;
    auto start = stop_at(from);
    if (!start) return followed;
    here_ = *start;
    for (const Stroke& stroke : strokes) {
      const std::size_t before = followed.keyframes.size();
      if (!follow_one(stroke, followed.keyframes)) {
        followed.keyframes.resize(before);
        break;
      }
      ++followed.strokes;
    }
    return followed;
  }

 private:
  std::optional<Stop> stop_at(const Vec3& cell) const {
    const auto q = field_.at(cell);
    if (!q) return std::nullopt;
    const ToolPose pose = chain_.tool_pose(*q);
    const Vec3 off = pose.ball_m - field_.ball_m(cell);
    const Vec3 top_off = off + chain_.stickout_m() * (pose.axis - field_.view().axis());
    return Stop{cell, *q, off.norm() / voxel_m_, top_off.norm() / voxel_m_};
  }

  bool follow_one(const Stroke& stroke, std::vector<Keyframe>& keyframes) {
    const Vec3 from = here_.cell;
    const double length = stroke.count > 0 ? stroke.count : (stroke.to - from).norm();
    const Vec3 along = (stroke.to - from) / length;
    const Voxel way = stroke.last - stroke.first;
    const auto sign = [](int x) { return (x > 0) - (x < 0); };
    const Voxel step{sign(way.i), sign(way.j), sign(way.k)};
    for (double done = 0; done < length;) {
      double piece = std::min(guess_, length - done);
      if (stroke.count > 0) piece = std::max(1.0, std::floor(piece));
      for (;;) {
        const bool last = done + piece >= length;
        const auto next = stop_at(last ? stroke.to : Vec3(from + along * (done + piece)));
        const double strayed = next ? stray_share(here_, *next, stroke) : 2;
        if (strayed <= 1) {
          Keyframe keyframe{next->q, stroke.count > 0, {}, {}};
          if (keyframe.cut) {
            const int first = static_cast<int>(done);
            keyframe.first = stroke.first + step * first;
            keyframe.last = stroke.first + step * (first + static_cast<int>(piece) - 1);
          }
          keyframes.push_back(std::move(keyframe));
          here_ = *next;
          done = last ? length : done + piece;
          if (strayed < 0.2)
            guess_ = std::min(longest_edge, 2 * piece);
          else if (strayed < 0.6)
            guess_ = std::max(guess_, piece + 1);
          break;
        }
        const double shorter = stroke.count > 0 ? std::floor(piece / 2) : piece / 2;
        if (shorter < (stroke.count > 0 ? 1.0 : 0.1)) return false;
        piece = guess_ = shorter;
      }
    }
    return true;
  }

  /// The largest share that any part of the tool uses of what it may stray; above 1 the edge is not certified. A
  /// function with second derivative at most b leaves its chord by b / 8 at most.
  double stray_share(const Stop& from, const Stop& to, const Stroke& stroke) const {
    if (!field_.links_are_free(from.cell, from.q, to.cell, to.q)) return 2;
    const Configuration step = to.q - from.q;
    const Bend bend = bend_of(from.q, step);
    const double ball = std::max(from.ball_off, to.ball_off) + bend.ball_m / (8 * voxel_m_);
    const double top = std::max(from.top_off, to.top_off) + bend.top_m / (8 * voxel_m_);
    const double wide = field_.may_stray(from.cell, to.cell) ? stroke.stray : 0;
    return std::max(ball / std::max(wide, stray_.ball), top / std::max(wide, stray_.shank));
  }

  /// Bounds on the second derivatives of ball and shank's end (m) all along the edge: their length in the middle and
  /// what the third derivative can add.
  struct Bend {
    double ball_m, top_m;
  };
  Bend bend_of(const Configuration& from, const Configuration& step) const {
    const double change = derivative_bounds(chain_, turn_rates_, speed_, step).third_m / 2;
    const Chain::ToolEnds middle = chain_.tool_acceleration(from + 0.5 * step, step);
    return {middle.ball_m.norm() + change, middle.top_m.norm() + change};
  }

  const PostureField& field_;
  const Chain& chain_;
  double voxel_m_;
  Stray stray_;
  Configuration speed_;       ///< m per unit of each joint, for the whole tool
  Configuration turn_rates_;  ///< rad per unit of each joint
  Stop here_;
  double guess_ = 8;  ///< voxel edges that the next edge is tried with
};

}  // namespace

Stray stray_of(const Tool& tool, double voxel_m) {
  return {std::min(most_ball_stray, 0.5 - tool.ball_radius_m / voxel_m - margin),
          0.5 - tool.shank_radius_m / voxel_m - margin};
}

Followed follow(const PostureField& field, const Tool& tool, const Grid& grid, const Vec3& from,
                const std::vector<Stroke>& strokes) {
  return Follower(field, tool, grid).run(from, strokes);
}

}  // namespace sculpt
