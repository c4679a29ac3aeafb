#include "core/timing/corners.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/law/coarse.hpp"
#include "core/timing/corner_cost.hpp"
#include "core/timing/edge.hpp"
#include "core/timing/room/edge_room.hpp"
#include "core/timing/window_corners.hpp"

namespace sculpt {
namespace {

constexpr double min_line = 0.02;        // of an edge: what parabolas leave of it
constexpr double max_x_by_length = 100;  // so that numbers of 32 bits tell accelerations well enough
constexpr double min_speed = 1e-9;

/// A point, the edge that leads to it, and what is known of its corner before its neighbours are.
struct Place {
  PathEdge edge;
  EdgeRoom room;
  CornerCost cost;
  double speed = std::numeric_limits<double>::infinity();  ///< r' is no more at the corner
  bool rest = false;
};

class CornerFinder {
 public:
  CornerFinder(const PlanPath& path, const PathTools& tools, const CornerDemands& demands)
      : path_(path),
        tools_(tools),
        demands_(demands),
        orders_(tools.first().rates.orders(2)),
        rooms_(make_rooms(path, tools.first())),
        window_(demands.window_s),
        places_(ring) {}

  Corners run() {
    corners_.law.resize(path_.size());
    corners_.caps.resize(path_.size());
    if (path_.size() == 1) return std::move(corners_);
    places_at_.end.put(tools_.first().rates, path_.configuration(0));
    place(0).rest = true;
    for (std::size_t point = 1; point < path_.size(); ++point) {
      demands_.go_on_from(point);
      go_to(point);
      if (point > WindowCorners::max_near) look_and_finish(point - WindowCorners::max_near);
    }
    place(path_.size() - 1).rest = true;
    for (std::size_t point = path_.size() - std::min(path_.size() - 1, WindowCorners::max_near);
         point + 1 < path_.size(); ++point)
      look_and_finish(point);
    while (done_ < path_.size()) finish(done_++, path_.size());
    return std::move(corners_);
  }

 private:
  static constexpr std::size_t ring = 256;

  static std::optional<EdgeRoomFinder> make_rooms(const PlanPath& path, const PathTool& tool) {
    if (path.header().mill) return {};
    return EdgeRoomFinder(path, tool.cell, tool.chain, tool.stray.reserve_m());
  }

  Place& place(std::size_t point) { return places_[point % ring]; }

  void go_to(std::size_t point) {
    Place& to = place(point) = {};
    const PlanPath::Edge& edge = path_.edge_to(point);
    const PathTool& tool = tools_.on_edge_to(path_, point);
    if (point > 1 && edge.tool != path_.edge_to(point - 1).tool)
      places_at_.begin.put(tool.rates, path_.configuration(point - 1));
    else
      places_at_.begin = places_at_.end;
    to.edge = make_edge(tool.rates, {demands_.acceleration, demands_.limits.velocity}, path_.configuration(point - 1),
                        path_.configuration(point), places_at_);
    to.edge.cut = edge.cut;
    to.edge.feed_m_s = demands_.feeds.of(edge, tool);
    to.edge.cap = 1 / std::max(to.edge.joint_rate, to.edge.ball / to.edge.feed_m_s);
    const EdgeSagitta sagitta = sagitta_of(tool.rates, to.edge, places_at_);
    to.room = rooms_ ? rooms_->go_to(point, sagitta, places_at_) : room_of(edge, tool.room, sagitta);
    to.rest = edge.rest;
    if (lowest_on_edge(sagitta) < path_.header().grid.origin_m.z()) last_low_ = point;
  }

  /// Of ball and shank, in the stock's frame.
  double lowest_on_edge(const EdgeSagitta& sagitta) const {
    const Tool& tool = path_.header().tool;
    const auto lowest = [&](const ToolPlace& place) {
      return place.pose.ball_m.z() + std::min(0.0, tool.stickout_m * place.pose.axis.z());
    };
    return std::min(lowest(places_at_.begin), lowest(places_at_.end)) - std::max(sagitta.ball, sagitta.top) -
           sagitta.more - std::max(tool.ball_radius_m, tool.shank_radius_m);
  }

  /// Of a milling tool: what its strokes are certified with, less what they use of it themselves.
  static EdgeRoom room_of(const PlanPath::Edge& edge, const MillRoom& room, const EdgeSagitta& sagitta) {
    if (edge.cut) return {true, {room.cut_m, sagitta.ball, sagitta.more}, {room.cut_m, sagitta.top, sagitta.more}};
    return {true, {room.beside(edge), 0, 0}, {room.beside(edge), 0, 0}};
  }

  /// As many points as a window may reach are known behind it.
  void look_and_finish(std::size_t point) {
    look_at_corner(point);
    while (done_ + WindowCorners::max_near < point) finish(done_++, point + 1);
  }

  void look_at_corner(std::size_t point) {
    Place& here = place(point);
    if (here.rest) return;
    const Place& next = place(point + 1);
    const PathTool& tool = tools_.on_edge_to(path_, point);
    const bool above = last_low_ == 0 || last_low_ + WindowCorners::max_near < point;
    here.cost =
        find_cost({tool.rates, tool.stray, point, above}, {{here.edge, here.room}, {next.edge, next.room}}, window_);
    if (here.cost.straight) return;
    const double rise = std::max(here.edge.line_acceleration, next.edge.line_acceleration);
    here.speed = divide(here.cost, here.edge, next.edge, rise);
    if (is_worth(here.cost.wanted, here.speed, std::min(here.edge.cap, next.edge.cap), rise)) return;
    here.rest = true;
    here.cost = {};
  }

  /// Divides what may be strayed so that the corner can be gone through fastest; gives that speed.
  double divide(CornerCost& cost, const PathEdge& first, const PathEdge& second, double rise) const {
    const double bend = (second.way - first.way).cwiseQuotient(demands_.acceleration).cwiseAbs().maxCoeff();
    const CornerCost most = cost;
    // The parabola's own acceleration is |w - u| v^2 / 2 half.
    const double cap = std::min(first.cap, second.cap), enough = bend * cap * cap / 2;
    double best = -1;
    for (const double parabola : {std::min(0.1, enough * cost.share / 4), 0.1, 0.2, 0.35, 0.5, max_parabola_share}) {
      const double half = std::min(most.wanted, 4 * parabola / cost.share),
                   speed = max_speed((1 - parabola) / cost.share, half, rise);
      const double least = std::min({speed, std::sqrt(2 * half / bend), cap});
      if (least <= best) continue;
      best = least;
      cost.parabola = parabola;
      cost.wanted = half;
    }
    return best;
  }

  /// At a corner, for the moving average to stray by no more than `left` of w - u.
  double max_speed(double left, double half, double acceleration) const {
    const double t = window_;
    if (t == 0) return std::numeric_limits<double>::infinity();
    return std::max(8 * (left - acceleration * t * t / 48) / t, std::sqrt(48 * half * left) / t - acceleration * t);
  }

  /// To go through the parabola so fast takes less than to come to rest for a window, from a speed of `usual`.
  bool is_worth(double half, double speed, double usual, double acceleration) const {
    return speed > min_speed && 2 * half / speed < 2 * half / usual + window_ + usual / acceleration;
  }

  /// r' at the corner: its parabola keeps to the feed of both edges.
  double corner_speed(std::size_t point, std::size_t known) {
    if (point == 0 || point + 1 >= known || place(point).rest) return 0;
    const PathEdge &first = place(point).edge, &second = place(point + 1).edge;
    const double feed = std::min(first.feed_m_s, second.feed_m_s);
    const auto speed = [&](const PathEdge& edge) { return 1 / std::max(edge.joint_rate, edge.ball / feed); };
    return std::min(place(point).speed, std::max(speed(first), speed(second)));
  }

  /// An edge, and the parabola between it and the one beside it.
  void note_edge(WindowCorners& around, std::size_t edge_at, std::size_t beside, double speed, std::size_t known) {
    around.add_edge(place(edge_at).edge, speed);
    if (beside > 0 && beside < known) around.add_rise(place(edge_at).edge, place(beside).edge);
  }

  /// `at`: by r, from the first one.
  void note_corner(WindowCorners& around, std::size_t point, double at, std::size_t known) {
    const Place& there = place(point);
    if (!there.rest && !there.cost.straight) around.add(there.cost, at, corner_speed(point, known));
  }

  /// Corners one behind the other from `point`, in steps of `step`, until a window is over in any case.
  void look_around(WindowCorners& around, std::size_t point, int step, std::size_t known) {
    const double half = place(point).cost.wanted;
    const std::size_t forth = step > 0 ? 1 : 0;
    double gone = 0, at = 0;                           // time since the end of the corner's parabola, at least; r
    double fastest_here = corner_speed(point, known);  // r' rises by no more than the lines' accelerations
    for (std::size_t count = 1;; ++count) {
      const std::size_t edge_at = point + forth;
      if (edge_at == 0 || edge_at >= known) return;
      const PathEdge& edge = place(edge_at).edge;
      const double speed = fastest(edge_at, known);
      fastest_here = std::min(std::max(edge.cap, fastest_here), fastest_here + edge.line_acceleration * window_);
      note_edge(around, edge_at, edge_at + 1 - 2 * forth, fastest_here, known);
      at += step * edge.length;
      point = point + 2 * forth - 1;
      const double own = count == 1 ? std::min(half, edge.length) : 0,
                   far = std::min(place(point).cost.wanted, edge.length);
      if (gone + (edge.length - own - far) / speed < window_) note_corner(around, point, at, known);
      gone += (edge.length - own) / speed;
      if (gone > window_) return;
      if (count == WindowCorners::max_near) {
        around.crowded = true;
        return;
      }
    }
  }

  double fastest(std::size_t edge_at, std::size_t known) {
    double speed = place(edge_at).edge.cap;
    if (edge_at > 1) speed = std::max(speed, place(edge_at - 1).edge.cap);
    if (edge_at + 1 < known) speed = std::max(speed, place(edge_at + 1).edge.cap);
    return speed;
  }

  /// All places before `known` are.
  void finish(std::size_t point, std::size_t known) {
    Place& here = place(point);
    LawCorner& corner = corners_.law[point];
    CornerCaps& caps = corners_.caps[point];
    const bool inside = point > 0 && point + 1 < path_.size();
    WindowCorners around;
    if (inside) note_corner(around, point, 0, known);
    if (point > 0) look_around(around, point, -1, known);
    if (point + 1 < path_.size()) look_around(around, point, 1, known);
    const double slower = around.feed_change(window_, tools_.first().rates);
    if (point > 0) set_cruise(corner, here.edge, std::max(slower, slower_before_));
    slower_before_ = slower;
    if (!inside || here.rest) return;
    caps.straight = here.cost.straight;
    if (caps.straight) {
      caps.cap = static_cast<float>(std::min(here.edge.cap, place(point + 1).edge.cap));
      return;
    }
    cut_off(point, around, slower);
  }

  static void set_cruise(LawCorner& corner, const PathEdge& edge, double slower) {
    const double feed = std::max(edge.feed_m_s - (edge.cut ? slower : 0), edge.feed_m_s / 2);
    corner.cruise = static_cast<float>(rounded_down(1 / std::max(edge.joint_rate, edge.ball / feed)));
  }

  void cut_off(std::size_t point, const WindowCorners& around, double slower) {
    const Place& here = place(point);
    const PathEdge &first = here.edge, &second = place(point + 1).edge;
    const double turned = window_ * around.turn_speed;
    const auto share = [](const PathEdge& edge, double others) {
      return (1 - min_line) * std::max(edge.length / 2, edge.length - others);
    };
    const double others_before = place(point - 1).cost.wanted, others_after = place(point + 1).cost.wanted;
    const double most = 4 * here.cost.parabola / (here.cost.share + turned * here.cost.share_by_turn);
    const double half =
        rounded_down(std::min({most, share(first, others_before), share(second, others_after), here.cost.wanted}));
    if (around.crowded || !(half > 0)) return;
    const double left = around.left / around.max_share(turned, window_);
    double speed = std::min({std::max(first.cap, second.cap), here.speed, max_speed(left, half, around.acceleration)});
    speed = std::min(speed, std::sqrt(max_x_by_length * std::min(first.length, second.length)));
    if (!is_worth(half, speed, std::min(first.cap, second.cap), around.acceleration)) return;
    corners_.law[point].half = static_cast<float>(half);
    corners_.caps[point] = caps_at_ends(here, second, half, slower);
    corners_.caps[point].cap = static_cast<float>(speed);
  }

  /// On the parabola the ball is at most as fast as on either edge, and as J differs there.
  CornerCaps caps_at_ends(const Place& here, const PathEdge& second, double half, double slower) const {
    const PathEdge& first = here.edge;
    const double beside = orders_ * here.cost.turn * half / 4,
                 along = orders_ * std::max(first.turn, second.turn) * half / 8;
    const double more = along * std::max(first.travel, second.travel);
    double feed = std::min(first.feed_m_s, second.feed_m_s);
    if (first.cut != second.cut) {
      // What is faster beyond the parabola is in the same window.
      const PathEdge& faster = first.cut ? second : first;
      slower += faster.line_acceleration * faster.ball * window_ / 4;
    }
    if (first.cut || second.cut) feed = std::max(feed - slower, feed / 2);
    const auto speed = [&](const PathEdge& edge) {
      return 1 / std::max(edge.joint_rate, (edge.ball + beside * edge.travel + more) / feed);
    };
    return {static_cast<float>(speed(first)), static_cast<float>(speed(second))};
  }

  const PlanPath& path_;
  const PathTools& tools_;
  const CornerDemands& demands_;
  const double orders_;
  std::optional<EdgeRoomFinder> rooms_;  // of a thin tool
  const double window_;
  std::vector<Place> places_;
  Corners corners_;
  EdgePlaces places_at_;  // of the tool on the last edge
  std::size_t done_ = 0;
  std::size_t last_low_ = 0;  // the last edge on which the tool may be below the stock's bottom; 0: none
  double slower_before_ = 0;
};

}  // namespace

Corners find_corners(const PlanPath& path, const PathTools& tools, const CornerDemands& demands) {
  return CornerFinder(path, tools, demands).run();
}

}  // namespace sculpt
