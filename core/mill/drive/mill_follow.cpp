#include "core/mill/drive/mill_follow.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/collision/shape/motion_bound.hpp"
#include "core/sweep/field/posture_lanes.hpp"
#include "core/trajectory/milling/quanta_point.hpp"

namespace sculpt {
namespace {

constexpr double intended_share = 0.9;    // of what the cutter may stray
constexpr double min_edge_m = 2e-5;       // of those that a stroke is cut into
constexpr double first_curvature = 2e-3;  // 1/m, before an edge was seen: strays of 0.02 mm in 9 mm
constexpr double close_m = 2e-7;          // of a posture's tip to where it should be

class MillFollower {
 public:
  MillFollower(const HeldTool& held, const PostureField& field, int direction)
      : held_(held),
        field_(field),
        chain_(field.chain()),
        direction_(direction),
        speed_(motion_bound(chain_, chain_.stock_link(), chain_.tool_link(), chain_.stickout_m())),
        turn_rates_(chain_.turn_rates()) {
    const Assembly& assembly = held.assembly();
    const double length = chain_.stickout_m();
    cutter_lever_ = (assembly.tool.cutter.flute_m + assembly.tool.cutter.radius_m) / length;
    body_lever_ = assembly.reach_m / length;
  }

  FollowedMill run(const Vec3& from, const std::vector<MillStroke>& strokes) {
    FollowedMill followed;
    if (!stand_at(from)) return followed;
    Place place{0, 0};
    Vec3 begin = here_.tip;
    for (bool stuck = false; !stuck && place.stroke < strokes.size();) {
      look_ahead(strokes, place, begin);
      if (pieces_.empty()) break;
      for (std::size_t lane = 0; lane < pieces_.size(); ++lane) {
        const Piece& piece = pieces_[lane];
        const MillStroke& stroke = strokes[piece.stroke];
        const double length = (piece.tip - here_.tip).norm();
        if (!take(piece, lane, stroke)) {
          stuck = length <= min_edge_m;
          edge_limit_m_ = length / 2;
          break;
        }
        edge_limit_m_ = max_edge_m;
        Keyframe keyframe{here_.q, stroke.cut, {}, {}, MillStep{piece.quanta, direction_, -1, 0}};
        followed.keyframes.push_back(std::move(keyframe));
        place = {piece.stroke, piece.share};
        if (piece.share >= 1) {
          followed.ends.push_back(followed.keyframes.size());
          begin = here_.tip;
          place = {piece.stroke + 1, 0};
        }
      }
    }
    followed.cut_to(place.stroke);
    return followed;
  }

 private:
  static constexpr double max_edge_m = 0.1;

  struct Stop {
    Vec3 tip, cell;
    Configuration q;
    double tip_off = 0, top_off = 0;
  };
  struct Place {
    std::size_t stroke;
    double share;  ///< of the stroke that is done
  };
  struct Piece {
    std::size_t stroke;
    double share;  ///< of the stroke, at its end
    QuantaPoint quanta;
    Vec3 tip, cell;
  };

  bool stand_at(const Vec3& from) {
    const Vec3 tip = point_of(quanta_of(from)), cell = HeldTool::cell_of(field_, held_.around(), tip);
    if (!field_.usable(cell)) return false;
    ahead_.set(0, tip, field_.guess(cell));
    field_.lanes().solve(ahead_, 2);
    here_ = stop_of(0, tip, cell);
    return ahead_.solved(0) && here_.tip_off < close_m;
  }

  Stop stop_of(std::size_t lane, const Vec3& tip, const Vec3& cell) const {
    return {tip, cell, ahead_.q.get(static_cast<int>(lane), chain_.dof()), ahead_.ball_off_m[lane],
            ahead_.top_off_m[lane]};
  }

  /// How long an edge may be to stray by `stray_m`, about: what it strays grows with the square of its length.
  double reach(double stray_m) const { return std::sqrt(8 * intended_share * stray_m / curvature_); }

  void look_ahead(const std::vector<MillStroke>& strokes, Place place, Vec3 begin) {
    pieces_.clear();
    Vec3 at = here_.tip;
    double most = edge_limit_m_;
    while (pieces_.size() < lane_count && place.stroke < strokes.size()) {
      const MillStroke& stroke = strokes[place.stroke];
      const double length = (stroke.tip_m - begin).norm(), left = (1 - place.share) * length;
      const double edge = std::min({most, reach(stroke.stray_m), max_edge_m});
      const double parts = std::max(1.0, std::ceil(left / edge - 1e-9));
      const double share = parts <= 1 ? 1 : place.share + (1 - place.share) / parts;
      Piece piece{place.stroke,
                  share,
                  quanta_of(share >= 1 ? stroke.tip_m : Vec3(begin + share * (stroke.tip_m - begin))),
                  {},
                  {}};
      piece.tip = point_of(piece.quanta);
      piece.cell = HeldTool::cell_of(field_, held_.around(), piece.tip);
      ahead_.set(static_cast<int>(pieces_.size()), piece.tip, field_.guess(piece.cell));
      at = piece.tip;
      pieces_.push_back(piece);
      place.share = share;
      if (share >= 1) {
        begin = at;
        place = {place.stroke + 1, 0};
      }
      most = max_edge_m;
    }
    field_.lanes().solve(ahead_, 2);
    bound_derivatives();
  }

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

  /// As for thin tools (core/sweep/follow): the sagitta by the derivatives in the middle, at both ends of the tool;
  /// what is beside or beyond these follows by how far the tool can turn.
  bool take(const Piece& piece, std::size_t lane, const MillStroke& stroke) {
    if (!ahead_.solved(static_cast<int>(lane)) || !field_.usable(piece.cell)) return false;
    Stop next = stop_of(lane, piece.tip, piece.cell);
    if (next.tip_off > close_m) return false;
    const double more = derivative_bounds(chain_, turn_[lane], travel_[lane]).fourth_m / 384;
    const auto deviation_of = [&](double off, double second, double third) {
      return off + second / 8 + third / (72 * std::numbers::sqrt3) + more;
    };
    const double tip = deviation_of(std::max(here_.tip_off, next.tip_off), edges_.ball_second_derivative[lane],
                                    edges_.ball_third_derivative[lane]);
    const double top = deviation_of(std::max(here_.top_off, next.top_off), edges_.top_second_derivative[lane],
                                    edges_.top_third_derivative[lane]);
    const double cutter = tip + cutter_lever_ * (tip + top), body = std::max(tip, top) + body_lever_ * (tip + top);
    const double length = (next.tip - here_.tip).norm();
    if (length > 0)
      curvature_ = std::max(1e-4, 8 * std::max(cutter, body * stroke.stray_m / body_stray_m) / (length * length));
    if (!(cutter <= stroke.stray_m && body <= std::max(body_stray_m, stroke.stray_m))) return false;
    if (!field_.links_are_free(here_.cell, here_.q, next.cell, next.q, held_bubble_)) return false;
    here_ = std::move(next);
    return true;
  }

  const HeldTool& held_;
  const PostureField& field_;
  const Chain& chain_;
  int direction_;
  Configuration speed_, turn_rates_;
  double cutter_lever_ = 0, body_lever_ = 0;
  double curvature_ = first_curvature;  ///< of the paths seen last, in effect
  double edge_limit_m_ = max_edge_m;    ///< after a refusal
  Stop here_;
  int held_bubble_ = -1;
  std::vector<Piece> pieces_;
  PostureBatch ahead_;
  EdgeBatch edges_;
  Lanes turn_, travel_;
};

}  // namespace

FollowedMill follow(const HeldTool& held, const PostureField& field, int direction, const Vec3& from,
                    const std::vector<MillStroke>& strokes) {
  return MillFollower(held, field, direction).run(from, strokes);
}

}  // namespace sculpt
