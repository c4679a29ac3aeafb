#include "core/mill/finish/envelope.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace sculpt {
namespace {

/// Of the ball's radius: how far apart it is looked where it rests; but no nearer and no farther than these.
constexpr double look_share = 1.0 / 6, nearest_look_m = 4e-4, farthest_look_m = 1.5e-3;
/// Beside an upright wall the line is cut until its pieces are shorter than this, in plan; of a line that must be
/// whole, which is a way and leaves nothing, sooner: up and over is no longer than such a wall.
constexpr double finest_m = 4e-6, finest_whole_m = 6e-5;

class Follower {
 public:
  Follower(const EnvelopeTask& task, const Point2& from, const Point2& to, const std::vector<WallStop>& stops)
      : task_(task), stops_(stops), from_(from), way_(to - from) {
    const double look = std::clamp(look_share * task.radius_m, nearest_look_m, farthest_look_m);
    pieces_ = static_cast<std::size_t>(std::max(1.0, std::ceil(way_.norm() / look)));
  }

  std::vector<Contour> run() {
    for (std::size_t at = 0; at <= pieces_; ++at) looks_.push_back(rest(share_of(at)));
    std::size_t begin = 0;
    while (begin < looks_.size()) {
      if (!looks_[begin]) {
        ++begin;
        continue;
      }
      std::size_t end = begin;
      while (end + 1 < looks_.size() && looks_[end + 1]) ++end;
      if (begin > 0)
        come_up(share_of(begin - 1), *looks_[begin], share_of(begin));
      else
        contours_.push_back({*looks_[begin]});
      go(begin, end);
      if (end < pieces_) go_down(*looks_[end], share_of(end), share_of(end + 1));
      begin = end + 1;
    }
    std::erase_if(contours_, [](const Contour& contour) { return contour.size() < 2; });
    return std::move(contours_);
  }

  Contour run_whole(double max_length_m) {
    looks_.resize(pieces_ + 1);
    // Most that are none are found out from a few places.
    if (!look_along(8, max_length_m) || !look_along(1, max_length_m)) return {};
    is_whole_ = true;
    contours_.push_back({*looks_.front()});
    const std::vector<std::size_t> over = find_taut();
    for (std::size_t at = 0; at + 1 < over.size(); ++at)
      if (const Vec3& to = *looks_[over[at + 1]]; is_proved(*looks_[over[at]], to))
        contours_.back().push_back(to);
      else
        go(over[at], over[at + 1]);
    if (contours_.size() != 1) return {};
    return std::move(contours_.front());
  }

 private:
  /// The edge of a wall and a place straight below it.
  struct Drop {
    Vec3 edge, low;
    double share;
  };

  /// Between a place where it rests and one where it does not.
  std::optional<Drop> find_drop(const Vec3& tip, double share, double off) const {
    const double length = way_.norm(), beside = std::abs(off - share) * length;
    Drop drop{tip, tip, share};
    auto stop = std::ranges::lower_bound(stops_, std::min(share, off) * length - beside, {}, &WallStop::along_m);
    double low = tip.z() - task_.radius_m;
    bool is_wall = false;
    for (; stop != stops_.end() && stop->along_m <= std::max(share, off) * length + beside; ++stop)
      if (stop->height_m < low) low = stop->height_m, is_wall = true;
    if (!is_wall) return std::nullopt;
    while (std::abs(off - drop.share) * length > finest_m) {
      const double middle = (off + drop.share) / 2;
      if (const auto at = rest(middle))
        drop.share = middle, drop.edge = *at;
      else
        off = middle;
    }
    drop.low.head<2>() = from_ + off * way_;
    drop.low.z() = low;
    if (is_proved(drop.edge, drop.low)) return drop;
    double high = drop.edge.z();
    while (high - low > nearest_look_m) {
      drop.low.z() = (high + low) / 2;
      (is_proved(drop.edge, drop.low) ? high : low) = drop.low.z();
    }
    drop.low.z() = high;
    return drop.edge.z() - high > nearest_look_m ? std::optional(drop) : std::nullopt;
  }

  /// A contour that begins where it rests first, or at the foot of a wall before that.
  void come_up(double off, const Vec3& tip, double share) {
    const auto drop = find_drop(tip, share, off);
    if (!drop) return contours_.push_back({tip});
    contours_.push_back({drop->low, drop->edge});
    join(drop->edge, drop->share, tip, share);
  }

  /// Where it rests last: as far as the foot of a wall after that.
  void go_down(const Vec3& tip, double share, double off) {
    const auto drop = find_drop(tip, share, off);
    if (!drop) return;
    join(tip, share, drop->edge, drop->share);
    contours_.back().push_back(drop->low);
  }

  /// Where a string that is pulled tight over all of these bends, and its ends.
  std::vector<std::size_t> find_taut() const {
    std::vector<std::size_t> taut;
    const auto rise = [&](std::size_t from, std::size_t to) {
      return (looks_[to]->z() - looks_[from]->z()) / static_cast<double>(to - from);
    };
    for (std::size_t at = 0; at <= pieces_; ++at) {
      while (taut.size() > 1 && rise(taut[taut.size() - 2], taut.back()) <= rise(taut.back(), at)) taut.pop_back();
      taut.push_back(at);
    }
    return taut;
  }

  /// Does it rest at all of these, no farther from the first to the last?
  bool look_along(std::size_t stride, double max_length_m) {
    double length = 0;
    for (std::size_t at = 0; at <= pieces_; at += stride) {
      if (!looks_[at]) looks_[at] = rest(share_of(at));
      if (!looks_[at]) return false;
      if (at > 0) length += (*looks_[at] - *looks_[at - stride]).norm();
      if (length > max_length_m) return false;
    }
    return true;
  }

  double share_of(std::size_t look) const { return static_cast<double>(look) / static_cast<double>(pieces_); }

  /// The tip at rest; nothing where there is nothing to rest on, or it may not be there.
  std::optional<Vec3> rest(double share) const {
    const Point2 at = from_ + share * way_;
    const double height = task_.columns.rest_height(at.x(), at.y(), task_.radius_m + task_.allowance_m, task_.bottom_m);
    if (height <= task_.bottom_m) return std::nullopt;
    const Vec3 tip(at.x(), at.y(), height - task_.radius_m);
    if (!task_.is_allowed(tip, tip)) return std::nullopt;
    return tip;
  }

  bool is_proved(const Vec3& from, const Vec3& to) const { return may_go(task_, from, to); }

  bool is_near(std::size_t from, std::size_t to) const {
    const Vec3 &a = *looks_[from], way = *looks_[to] - a;
    const double level = way.head<2>().norm() / std::max(way.norm(), 1e-12);
    for (std::size_t at = from + 1; at < to; ++at) {
      const double share = static_cast<double>(at - from) / static_cast<double>(to - from);
      if ((a.z() + share * way.z() - looks_[at]->z()) * level > task_.chord_m) return false;
      if (a.z() + share * way.z() < looks_[at]->z() - task_.allowance_m) return false;
    }
    return true;
  }

  void go(std::size_t from, std::size_t to) {
    if (from == to || is_given_up()) return;
    if (is_near(from, to) && is_proved(*looks_[from], *looks_[to])) return contours_.back().push_back(*looks_[to]);
    if (to - from > 1) {
      const std::size_t middle = (from + to) / 2;
      go(from, middle);
      go(middle, to);
      return;
    }
    divide(*looks_[from], share_of(from), *looks_[to], share_of(to));
  }

  void join(const Vec3& a, double share_a, const Vec3& b, double share_b) {
    if (is_proved(a, b)) return contours_.back().push_back(b);
    divide(a, share_a, b, share_b);
  }

  /// Of an edge that is not proved.
  void divide(const Vec3& a, double share_a, const Vec3& b, double share_b) {
    if (is_given_up()) return;
    if ((b - a).head<2>().norm() > (is_whole_ ? finest_whole_m : finest_m)) {
      const double share = (share_a + share_b) / 2;
      if (const auto middle = rest(share)) {
        for (const auto& [from, share_from, to, share_to] :
             {std::tuple{a, share_a, *middle, share}, std::tuple{*middle, share, b, share_b}})
          join(from, share_from, to, share_to);
        return;
      }
      go_down(a, share_a, share);
      return come_up(share, b, share_b);
    }
    contours_.push_back({b});
  }

  bool is_given_up() const { return is_whole_ && contours_.size() > 1; }

  const EnvelopeTask& task_;
  const std::vector<WallStop>& stops_;
  bool is_whole_ = false;  ///< in one piece or not at all
  Point2 from_, way_;
  std::size_t pieces_ = 1;
  std::vector<std::optional<Vec3>> looks_;
  std::vector<Contour> contours_;
};

}  // namespace

double length_m(const Contour& contour) {
  double length = 0;
  for (std::size_t edge = 0; edge + 1 < contour.size(); ++edge) length += (contour[edge + 1] - contour[edge]).norm();
  return length;
}

bool may_go(const EnvelopeTask& task, const Vec3& from, const Vec3& to) {
  const Vec3 up(0, 0, task.radius_m);
  return task.is_allowed(from, to) && task.columns.is_clear(from + up, to + up, task.radius_m + task.clear_m);
}

std::vector<Contour> follow_envelope(const EnvelopeTask& task, const Point2& from, const Point2& to,
                                     const std::vector<WallStop>& stops) {
  return Follower(task, from, to, stops).run();
}

Contour follow_whole(const EnvelopeTask& task, const Point2& from, const Point2& to, double max_length_m) {
  return Follower(task, from, to, {}).run_whole(max_length_m);
}

}  // namespace sculpt
