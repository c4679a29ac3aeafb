#include "core/timing/motion/held_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/base/error.hpp"

namespace sculpt {
namespace {

constexpr std::size_t points_a_mark = 256;
/// The law's own accelerations are rounded so little; its limits are 5e-4 below the joints'.
constexpr double joint_rounding = 1e-6;

/// What r'' may be: within -a and a are all of `way` r'' + `bend` x.
struct Rises {
  double low = -1e300, high = 1e300;

  void keep(const Configuration& way, const Configuration& bend, double x, const Configuration& a) {
    for (Eigen::Index j = 0; j < way.size(); ++j) {
      const double by = std::abs(way[j]);
      if (by * 1e12 < a[j] / 1e6) continue;
      const double middle = -bend[j] * x / way[j], reach = a[j] * (1 + joint_rounding) / by;
      low = std::max(low, middle - reach);
      high = std::min(high, middle + reach);
    }
  }
};

}  // namespace

HeldPieces::HeldPieces(const PlanPath& path, const TimeLaw& law) : law_(law), pieces_(path, law) {
  marks_.push_back(pieces_.mark());
  MotionPiece piece;
  for (std::size_t point = 0; pieces_.next(piece);) {
    law_end_s_ = piece.end_s();
    if (piece.point == point) continue;
    point = piece.point;
    // The mark of a point is behind it: pieces of the next one follow.
    if (point % points_a_mark == 0 && !piece.parabola) marks_.push_back({point - 1, piece.begin_s});
  }
  go_to(0);
}

bool HeldPieces::next_of_law(MotionPiece& piece) {
  if (!is_left_) return pieces_.next(piece);
  piece = left_;
  is_left_ = false;
  return true;
}

void HeldPieces::go_to_law(double law_s) {
  const auto mark = std::ranges::upper_bound(marks_, law_s, {}, &MotionPieces::Mark::time_s);
  pieces_.go_to(mark == marks_.begin() ? marks_.front() : *(mark - 1));
  is_left_ = false;
}

void HeldPieces::go_to(double time_s) {
  splice_ = 0;
  taken_ = 0;
  inside_ = false;
  double shift_s = 0;
  while (splice_ < splices_.size() && time_s >= splices_[splice_].to_s + splices_[splice_].shift_s)
    shift_s = splices_[splice_++].shift_s;
  double law_s = std::max(0.0, time_s - shift_s);
  if (splice_ < splices_.size()) law_s = std::min(law_s, splices_[splice_].from_s);
  go_to_law(law_s);
  if (splice_ == 0) return;
  // A mark that is before the end of the last splice would give what that one has replaced.
  const double from_s = splices_[splice_ - 1].to_s;
  for (MotionPiece piece; pieces_.next(piece);) {
    if (piece.end_s() <= from_s) continue;
    left_ = piece.begin_s < from_s ? piece.behind(from_s - piece.begin_s) : piece;
    is_left_ = true;
    return;
  }
}

bool HeldPieces::next(MotionPiece& piece) {
  if (inside_) {
    const Splice& splice = splices_[splice_];
    if (taken_ < splice.pieces.size()) {
      piece = splice.pieces[taken_++];
      return true;
    }
    inside_ = false;
    ++splice_;
    // What the law has there was left when the splice began.
    MotionPiece law;
    do {
      if (!next_of_law(law)) return false;
    } while (law.end_s() <= splice.to_s);
    left_ = law.begin_s < splice.to_s ? law.behind(splice.to_s - law.begin_s) : law;
    is_left_ = true;
  }
  if (!next_of_law(piece)) return false;
  if (splice_ < splices_.size() && piece.end_s() > splices_[splice_].from_s) {
    const Splice& splice = splices_[splice_];
    left_ = piece;
    is_left_ = inside_ = true;
    taken_ = 0;
    if (!(splice.from_s > piece.begin_s)) return next(piece);
    piece = piece.before(splice.from_s - piece.begin_s);
  }
  if (splice_ > 0) piece.begin_s += splices_[splice_ - 1].shift_s;
  return true;
}

bool HeldPieces::find(double law_s, Place& place) {
  go_to_law(law_s);
  while (pieces_.next(place.piece)) {
    if (place.piece.end_s() <= law_s) continue;
    const double t = std::max(0.0, law_s - place.piece.begin_s);
    place.s = (place.piece.speed + place.piece.rise * t / 2) * t;
    place.x = place.piece.x_at(place.s);
    return true;
  }
  return false;
}

bool HeldPieces::go_on(Place& place) {
  place.s = 0;
  return pieces_.next(place.piece);
}

void HeldPieces::add(Splice& splice, const Place& from, double length, double rise) const {
  const double speed = std::sqrt(from.x), end = std::sqrt(std::max(0.0, from.x + 2 * rise * length));
  if (!(length > 0) || !(speed + end > 0)) return;
  MotionPiece piece = from.piece;
  piece.at = from.piece.at + from.piece.way * from.s + from.piece.bend * (from.s * from.s / 2);
  piece.way = from.piece.way + from.piece.bend * from.s;
  piece.begin_s = from.time_s;
  piece.seconds = 2 * length / (speed + end);
  piece.speed = speed;
  piece.rise = rise;
  splice.pieces.push_back(piece);
  splice.law_s.push_back(from.piece.begin_s + from.piece.seconds_to(from.s));
}

void HeldPieces::rest(Splice& splice, const Place& place) const {
  MotionPiece piece = place.piece;
  piece.at = place.piece.at + place.piece.way * place.s + place.piece.bend * (place.s * place.s / 2);
  piece.way.setZero();
  piece.bend.setZero();
  piece.speed = piece.rise = 0;
  piece.begin_s = place.time_s;
  piece.seconds = law_.window_s + hold_rest_s;
  splice.pieces.push_back(piece);
  splice.law_s.push_back(place.piece.begin_s + place.piece.seconds_to(place.s));
}

/// The smallest speeds that the limits allow, until there is none.
void HeldPieces::brake(Splice& splice, Place& place) {
  const Eigen::Map<const Configuration> limit(law_.acceleration.data(),
                                              static_cast<Eigen::Index>(law_.acceleration.size()));
  const Configuration a = limit;
  const auto go = [&](double length, double rise) {
    const std::size_t had = splice.pieces.size();
    add(splice, place, length, rise);
    if (splice.pieces.size() > had) place.time_s = splice.pieces.back().end_s();
    place.s += length;
    place.x = std::max(0.0, place.x + 2 * rise * length);
  };
  while (place.x > 0) {
    const MotionPiece& law = place.piece;
    const double length = law.length() - place.s, law_x = law.x_at(place.s);
    if (!(length > 0)) {
      if (!go_on(place)) return;
      place.x = std::min(place.x, place.piece.x_at(0));
      continue;
    }
    const Configuration way = law.way + law.bend * place.s;
    const double scaled = law.rise * (law_x > 0 ? std::min(1.0, place.x / law_x) : 1);
    Rises to_rest, through;
    to_rest.keep(way, law.bend, place.x, a);
    through = to_rest;
    to_rest.keep(way, law.bend, -place.x / 2, a);
    if (to_rest.low < 0 && to_rest.low <= to_rest.high && place.x <= -2 * to_rest.low * length)
      return go(place.x / (-2 * to_rest.low), to_rest.low);
    through.keep(way + 3 * length * law.bend, law.bend, place.x, a);
    go(length, std::min(std::max(through.low, -place.x / (2 * length)), scaled));
    if (!go_on(place)) return;
    place.x = std::min(place.x, place.piece.x_at(0));
  }
}

/// The largest speeds that the limits allow, until they are the law's.
void HeldPieces::rise(Splice& splice, Place& place) {
  const Eigen::Map<const Configuration> limit(law_.acceleration.data(),
                                              static_cast<Eigen::Index>(law_.acceleration.size()));
  const Configuration a = limit;
  const auto go = [&](double length, double rise) {
    add(splice, place, length, rise);
    place.time_s = splice.pieces.back().end_s();
    place.s += length;
    place.x += 2 * rise * length;
  };
  bool more = true;
  while (more) {
    const MotionPiece& law = place.piece;
    const double length = law.length() - place.s, law_x = law.x_at(place.s);
    if (length > 0) {
      if (place.x >= law_x) break;
      Rises rises;
      const Configuration way = law.way + law.bend * place.s;
      rises.keep(way, law.bend, place.x, a);
      rises.keep(way + 3 * length * law.bend, law.bend, place.x, a);
      const double scaled = law.rise * place.x / law_x, high = std::max(rises.high, scaled),
                   until = high > law.rise ? (law_x - place.x) / (2 * (high - law.rise)) : length;
      go(std::min(until, length), high);
      if (until < length) break;
    } else if (law.speed == 0 && law.rise == 0 && place.s == 0 && place.x == 0 && law.seconds > 0) {
      break;  // a rest of the law's own
    }
    more = go_on(place);
  }
  splice.to_s = more ? place.piece.begin_s + place.piece.seconds_to(place.s) : law_end_s_;
  splice.shift_s = place.time_s - splice.to_s;
}

PathHold HeldPieces::add_hold(double begin_s) {
  if (begin_s >= end_s()) return {begin_s, end_s() + law_.window_s};
  Place place;
  Splice next;
  if (!splices_.empty() && begin_s < splices_.back().to_s + splices_.back().shift_s) {
    // While it goes on from the hold before: that one's splice is gone on with.
    next = std::move(splices_.back());
    splices_.pop_back();
    const auto at = std::ranges::upper_bound(next.pieces, begin_s, {}, &MotionPiece::begin_s) - 1;
    const auto index = static_cast<std::size_t>(at - next.pieces.begin());
    const double t = begin_s - at->begin_s, gone = (at->speed + at->rise * t / 2) * t;
    find(next.law_s[index], place);
    place.s += gone;
    place.x = std::pow(std::max(0.0, at->speed + at->rise * t), 2);
    next.pieces.resize(index + 1);
    next.law_s.resize(index + 1);
    next.pieces.back() = next.pieces.back().before(t);
    if (!(t > 0)) {
      next.pieces.pop_back();
      next.law_s.pop_back();
    }
  } else {
    next.from_s = begin_s - (splices_.empty() ? 0 : splices_.back().shift_s);
    find(next.from_s, place);
  }
  place.time_s = begin_s;
  brake(next, place);
  place.x = 0;
  rest(next, place);
  const PathHold hold{begin_s, place.time_s + law_.window_s};
  place.time_s = hold.rest_s + hold_rest_s;
  if (place.piece.speed == 0 && place.piece.rise == 0 && place.s == 0) go_on(place);  // it has been rested at
  rise(next, place);
  splices_.push_back(std::move(next));
  return hold;
}

void HeldPieces::hold(const std::vector<double>& begins_s) {
  holds_.clear();
  splices_.clear();
  for (const double begin_s : begins_s) {
    if (!holds_.empty() && begin_s < holds_.back().rest_s) {
      std::ostringstream text;
      text << "a hold at " << begin_s << " s cannot begin before the one at " << holds_.back().begin_s
           << " s has come to rest, at " << holds_.back().rest_s << " s: give a later time";
      throw InputError("hold_invalid", text.str());
    }
    holds_.push_back(add_hold(begin_s));
  }
  go_to(0);
}

}  // namespace sculpt
