#include "core/sweep/follow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/collision/margins.hpp"
#include "core/collision/shape/motion_bound.hpp"
#include "core/sweep/field/posture_lanes.hpp"

namespace sculpt {
namespace {

// Edges, in voxel edges. A cut has a voxel at least.
constexpr double max_edge = 64, min_move = 0.1, first_edge = 8;
constexpr double intended_share = 0.95;  // of what the tool may tolerance
constexpr double shorter = 0.98;         // than a refused edge; more than the root of the intended share

/// A place on the way along strokes. Strokes without length are passed over.
class Place {
 public:
  Place(const Vec3& from, const std::vector<Stroke>& strokes) : strokes_(&strokes), from_(from) { begin(); }

  bool at_end() const { return index_ == strokes_->size(); }
  /// Strokes that are done.
  std::size_t strokes() const { return index_; }
  const Stroke& stroke() const { return (*strokes_)[index_]; }
  /// Where the stroke began, and one voxel edge along it.
  const Vec3& from() const { return from_; }
  const Vec3& along() const { return along_; }
  /// Of the stroke, in voxel edges.
  double done() const { return done_; }
  double left() const { return length_ - done_; }

  Vec3 cell() const { return from_ + along_ * done_; }
  /// To the end of the stroke if it is no longer than that.
  void advance(double length) {
    if (length < left()) {
      done_ += length;
      return;
    }
    from_ = stroke().to;
    ++index_;
    begin();
  }

 private:
  void begin() {
    for (done_ = 0; !at_end(); ++index_) {
      length_ = stroke().count > 0 ? stroke().count : (stroke().to - from_).norm();
      if (length_ == 0) continue;
      along_ = (stroke().to - from_) / length_;
      return;
    }
  }

  const std::vector<Stroke>* strokes_;
  std::size_t index_ = 0;
  Vec3 from_, along_ = Vec3::Zero();
  double length_ = 0, done_ = 0;
};

/// Part of a stroke that one edge is to follow.
struct Piece {
  Place from;
  double length;
  Vec3 end;  ///< cells

  bool cuts() const { return from.stroke().count > 0; }
};

/// A configuration and where it was meant to have the ball.
struct Stop {
  Vec3 cell;
  Configuration q;
  double ball_off = 0, top_off = 0;  ///< from where ball and shank's end should be (voxel edges)
};

/// Bounds on how far one end of the tool is from the line of an edge, in voxel edges: what the edge's ends are off, the
/// sagitta of an arc with the second derivative of the middle (it grows with the square of the edge's length), and what
/// the third and fourth derivatives add to it (with the cube and more).
struct EndDeviation {
  double off, sagitta, skew;

  double all() const { return off + sagitta + skew; }
  /// How much longer an edge like this may be, about, to use `room`: the x with sagitta x^2 + skew x^3 = room - off.
  double stretch(double room, double most) const {
    const double left = room - off;
    if (!(left > 0)) return 0;
    double x = std::min(std::sqrt(left / (sagitta + skew)), most);
    for (int step = 0; step < 2; ++step) {
      const double excess = x * x * (sagitta + skew * x) - left;
      if (!(excess > 0)) break;
      x -= excess / (x * (2 * sagitta + 3 * skew * x));
    }
    return x;
  }
};

struct EdgeDeviation {
  double length;  ///< of the edge, in voxel edges
  EndDeviation ball, top;

  /// The largest share of the tolerance; above 1 the edge is not certified.
  double share(const PathTolerance& allowed) const {
    return std::max(ball.all() / allowed.ball, top.all() / allowed.shank);
  }
  /// How long an edge like this may be to use the intended share.
  double reach(const PathTolerance& allowed) const {
    const double most = max_edge / length;
    return length * std::min(ball.stretch(intended_share * allowed.ball, most),
                             top.stretch(intended_share * allowed.shank, most));
  }
};

/// Solves the next pieces together, as if none of them were refused, and goes on from the first that is.
class Follower {
 public:
  Follower(const PostureField& field, const Tool& tool, const Grid& grid)
      : field_(field),
        chain_(field.chain()),
        voxel_m_(grid.voxel_m),
        tolerance_(path_tolerance(tool, grid.voxel_m)),
        speed_(motion_bound(chain_, chain_.stock_link(), chain_.tool_link(), tool.stickout_m)),
        turn_rates_(chain_.turn_rates()) {}

  FollowedStrokes run(const Vec3& from, const std::vector<Stroke>& strokes) {
    FollowedStrokes followed;
    if (!stand_at(from)) return followed;
    Place place(from, strokes);
    std::size_t in_whole_strokes = 0;
    for (bool refused_at_all = false; !refused_at_all && !place.at_end();) {
      look_ahead(place);
      for (std::size_t lane = 0; lane < pieces_.size(); ++lane) {
        const Piece& piece = pieces_[lane];
        if (!take(piece, lane)) {
          refused_at_all = piece.length <= (piece.cuts() ? 1 : min_move);
          break;
        }
        followed.keyframes.push_back(keyframe_at_end(piece));
        place.advance(piece.length);
        if (place.strokes() > piece.from.strokes()) in_whole_strokes = followed.keyframes.size();
      }
    }
    followed.keyframes.resize(in_whole_strokes);
    followed.strokes = place.strokes();
    return followed;
  }

 private:
  bool stand_at(const Vec3& cell) {
    if (!field_.usable(cell)) return false;
    put(0, cell);
    field_.lanes().solve(ahead_);
    here_ = stop_of(0, cell);
    return ahead_.solved(0);
  }

  void put(std::size_t lane, const Vec3& cell) {
    ahead_.set(static_cast<int>(lane), field_.ball_m(cell), field_.guess(cell));
  }

  Stop stop_of(std::size_t lane, const Vec3& cell) const {
    return {cell, ahead_.q.get(static_cast<int>(lane), chain_.dof()), ahead_.ball_off_m[lane] / voxel_m_,
            ahead_.top_off_m[lane] / voxel_m_};
  }

  void look_ahead(Place place) {
    pieces_.clear();
    for (double most = max_next_; pieces_.size() < lane_count && !place.at_end(); most = max_edge) {
      Piece piece{place, next_length(place, most), {}};
      place.advance(piece.length);
      piece.end = place.cell();
      put(pieces_.size(), piece.end);
      pieces_.push_back(piece);
    }
    field_.lanes().solve(ahead_);
    bound_derivatives();
  }

  /// So that the rest of the stroke becomes as few pieces as can be expected, all about as long.
  double next_length(const Place& place, double most) const {
    const Stroke& stroke = place.stroke();
    const auto& known = known_[direction_of(place.along())];
    most = std::min(most, known ? known->reach(allowed(place.from(), stroke.to, stroke)) : first_edge);
    most = stroke.count > 0 ? std::max(1.0, std::floor(most)) : std::max(min_move, most);
    const double pieces = std::ceil(place.left() / most);
    if (pieces <= 1) return place.left();
    return stroke.count > 0 ? std::ceil(place.left() / pieces) : place.left() / pieces;
  }

  /// One of the three axes, or none.
  static std::size_t direction_of(const Vec3& along) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (std::abs(along[static_cast<int>(axis)]) > 0.999) return axis;
    return 3;
  }

  PathTolerance allowed(const Vec3& from, const Vec3& to, const Stroke& stroke) const {
    const double wide = field_.allows_wide_path(from, to) ? stroke.tolerance : 0;
    return {std::max(wide, tolerance_.ball), std::max(wide, tolerance_.shank)};
  }

  /// The derivatives of the paths of ball and shank's end in the middle of each edge, and what bounds those of higher
  /// order.
  void bound_derivatives() {
    turn_.fill(0);
    travel_.fill(0);
    for (int c = 0; c < chain_.dof(); ++c) {
      const auto joint = static_cast<std::size_t>(c);
      const Lanes& to = edges_.to.joints[joint] = ahead_.q.joints[joint];
      Lanes& from = edges_.from.joints[joint];
      from[0] = here_.q[c];
      std::copy(to.begin(), to.end() - 1, from.begin() + 1);
      for (std::size_t lane = 0; lane < lane_count; ++lane) {
        const double step = std::abs(to[lane] - from[lane]);
        turn_[lane] += turn_rates_[c] * step;
        travel_[lane] += speed_[c] * step;
      }
    }
    field_.lanes().derive(edges_);
  }

  /// Goes to the end of the next piece if the edge there is certified. A function with the second and third derivative
  /// b and c in the middle, and a fourth that is at most d, has the second derivative b + c u + r at 1/2 + u, where r
  /// is at most d u^2 / 2. It leaves its chord by what these three do: b / 8, c / (72 sqrt 3) and d / 384 at most.
  bool take(const Piece& piece, std::size_t lane) {
    max_next_ = piece.length / 2;
    if (!ahead_.solved(static_cast<int>(lane))) return false;
    Stop next = stop_of(lane, piece.end);
    const double more = derivative_bounds(chain_, turn_[lane], travel_[lane]).fourth_m / 384;
    const auto deviation_of = [&](double off, double second, double third) -> EndDeviation {
      return {off, second / (8 * voxel_m_), (third / (72 * std::numbers::sqrt3) + more) / voxel_m_};
    };
    const EdgeDeviation deviation{piece.length,
                                  deviation_of(std::max(here_.ball_off, next.ball_off),
                                               edges_.ball_second_derivative[lane], edges_.ball_third_derivative[lane]),
                                  deviation_of(std::max(here_.top_off, next.top_off),
                                               edges_.top_second_derivative[lane], edges_.top_third_derivative[lane])};
    known_[direction_of(piece.from.along())] = deviation;
    if (!(deviation.share(allowed(here_.cell, next.cell, piece.from.stroke())) <= 1)) {
      max_next_ = shorter * piece.length;  // what was learnt makes it shorter yet, as a rule
      return false;
    }
    if (!field_.links_are_free(here_.cell, here_.q, next.cell, next.q, held_)) return false;
    here_ = std::move(next);
    max_next_ = max_edge;
    return true;
  }

  Keyframe keyframe_at_end(const Piece& piece) const {
    Keyframe keyframe{here_.q, piece.cuts(), {}, {}};
    if (!keyframe.cut) return keyframe;
    const Stroke& stroke = piece.from.stroke();
    const Voxel step = sign(stroke.last - stroke.first);
    keyframe.first = stroke.first + step * static_cast<int>(piece.from.done());
    keyframe.last = keyframe.first + step * (static_cast<int>(piece.length) - 1);
    return keyframe;
  }

  const PostureField& field_;
  const Chain& chain_;
  double voxel_m_;
  PathTolerance tolerance_;
  Configuration speed_;       ///< m per unit of each joint, for the whole tool
  Configuration turn_rates_;  ///< rad per unit of each joint

  Stop here_;
  int held_ = -1;                                        ///< number of a bubble of the field that holds it, if known
  double max_next_ = max_edge;                           ///< after a refusal
  std::array<std::optional<EdgeDeviation>, 4> known_{};  ///< of the last edge along each axis, and along none
  std::vector<Piece> pieces_;                            ///< from here on, one per lane
  PostureBatch ahead_;                                   ///< their ends
  EdgeBatch edges_;
  Lanes turn_, travel_;  ///< along each edge, of all joints together (rad; m)
};

}  // namespace

PathTolerance path_tolerance(const Tool& tool, double voxel_m) {
  return {std::min(max_ball_deviation, 0.5 - tool.ball_radius_m / voxel_m - tool_margin_voxels),
          0.5 - tool.shank_radius_m / voxel_m - tool_margin_voxels};
}

FollowedStrokes follow(const PostureField& field, const Tool& tool, const Grid& grid, const Vec3& from,
                       const std::vector<Stroke>& strokes) {
  return Follower(field, tool, grid).run(from, strokes);
}

}  // namespace sculpt
