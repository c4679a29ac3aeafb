#include "core/timing/slow_places.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/base/error.hpp"
#include "core/timing/edge.hpp"

namespace sculpt {
namespace {

constexpr std::size_t max_places = 10;
constexpr double at_feed = 1 - 1e-3;  // of the feed: what is above that is as fast as was asked for

std::string text(double value) {
  std::ostringstream out;
  out.precision(4);
  out << value;
  return out.str();
}

class SlowPlaces {
 public:
  SlowPlaces(const PlanPath& path, const PathTools& tools, const Configuration& velocity, const TimeLaw& law,
             const MotionDemands& demands)
      : path_(path),
        tools_(tools),
        law_(law),
        demands_(demands),
        velocity_(velocity),
        acceleration_(Eigen::Map<const Configuration>(law.acceleration.data(),
                                                      static_cast<Eigen::Index>(law.acceleration.size()))) {}

  std::vector<SlowPlace> run() {
    for (std::size_t point = 1; point < path_.size(); ++point)
      if (path_.edge_to(point).cut) look_at(point);
    std::vector<SlowPlace> places;
    for (const Found& found : found_) places.push_back(describe(found));
    return places;
  }

 private:
  struct Found {
    std::size_t point;
    double feed_m_s;
  };

  const LawCorner& corner(std::size_t point) const { return law_.corners[path_.edge_to(point).keyframe - 1]; }

  /// Does the edge to `point` go on along the same line of the grid as the one before it?
  bool goes_on(std::size_t point) const {
    if (point == 0 || point + 1 >= path_.size()) return false;
    const PlanPath::Edge &edge = path_.edge_to(point), &next = path_.edge_to(point + 1);
    if (path_.header().mill) return edge.cut && next.cut;
    return edge.voxels > 0 && next.voxels > 0 && edge.way != 0 && edge.way == next.way;
  }

  double feed_of(std::size_t point) const {
    return std::min(demands_.feed_m_s, tools_.on_edge_to(path_, point).feed_m_s);
  }

  Voxel voxel_at(std::size_t point) const {
    const PlanPath::Edge& edge = path_.edge_to(point);
    if (!path_.header().mill) return {edge.last[0], edge.last[1], edge.last[2]};
    const Grid& grid = path_.header().grid;
    const Vec3 tip = tools_.on_edge_to(path_, point).chain.tool_pose(path_.configuration(point)).ball_m;
    const Vec3 at = ((tip - grid.origin_m) / grid.voxel_m).array().floor();
    return {static_cast<int>(at.x()), static_cast<int>(at.y()), static_cast<int>(at.z())};
  }

  /// What is no slower changes nothing.
  double slow_enough(double feed) const {
    const double wanted =
        found_.size() < max_places ? at_feed * feed : std::min(at_feed * feed, found_.back().feed_m_s);
    return demands_.keep_feed ? std::max(wanted, *demands_.keep_feed * feed) : wanted;
  }

  /// A lower bound of the ball's speed (m by r) at both ends of the edge, without kinematics: of a thin tool's cut
  /// behind another one both places of the ball are known, so its mean speed is, which the ends differ from by no more
  /// than half of what its speed changes. 0 where nothing is known.
  double least_ball_rate(std::size_t point, const Configuration& way, double length, const ToolRates& rates) const {
    constexpr double off_centre = 0.02;  // voxels, of both together: certificates allow 0.005 each
    if (path_.header().mill || point < 2 || !path_.edge_to(point - 1).cut) return 0;
    const auto centre = [](const PlanPath::Edge& edge) { return Vec3(edge.last[0], edge.last[1], edge.last[2]); };
    const double chord_m = ((centre(path_.edge_to(point)) - centre(path_.edge_to(point - 1))).norm() - off_centre) *
                           path_.header().grid.voxel_m;
    const double second = rates.orders(2) * rates.turn.dot(way.cwiseAbs()) * rates.travel.dot(way.cwiseAbs());
    return std::max(0.0, chord_m / length - second * length / 2);
  }

  /// The ball's slowest speed on the edge, without the voxels at the ends of a line of cuts.
  void look_at(std::size_t point) {
    const PlanPath::Edge& edge = path_.edge_to(point);
    const bool begins = !goes_on(point - 1), ends = !goes_on(point);
    const int voxels = path_.header().mill ? 1 : edge.voxels;
    const double voxel = 1.0 / voxels;
    if (begins + ends >= voxels) return;
    const ToolRates& rates = tools_.on_edge_to(path_, point).rates;
    const double feed = feed_of(point);
    const Configuration step = path_.configuration(point) - path_.configuration(point - 1);
    const double length = step.cwiseQuotient(acceleration_).norm(),
                 rise = 1 / (step / length).cwiseQuotient(acceleration_).cwiseAbs().maxCoeff();
    const Configuration way = step / length;
    const double cruise = static_cast<double>(corner(point).cruise);
    const float x_before = point > 1 ? corner(point - 1).x_mid : 0, x_after = corner(point).x_mid;
    const bool by_joints = cruise * way.cwiseAbs().cwiseQuotient(velocity_).maxCoeff() > at_feed;
    if (!by_joints && std::sqrt(static_cast<double>(std::min(x_before, x_after))) >= at_feed * cruise) return;
    const auto rate_at = [&](float x, bool is_line_end) {
      // One voxel from where the line of cuts ends the motion may have risen again.
      const double there = static_cast<double>(x) + (is_line_end ? 2 * rise * voxel * length : 0);
      return std::sqrt(std::min(there, cruise * cruise));
    };
    const double rate_before = rate_at(x_before, begins), rate_after = rate_at(x_after, ends);
    if (std::min(rate_before, rate_after) * least_ball_rate(point, way, length, rates) >= slow_enough(feed)) return;
    ToolPlace before, after;
    before.put(rates, path_.configuration(point - 1));
    after.put(rates, path_.configuration(point));
    const double slowest = std::min({feed, rate_before * before.ball(way).norm(), rate_after * after.ball(way).norm()});
    if (slowest >= at_feed * feed) return;
    if (demands_.keep_feed && slowest < *demands_.keep_feed * feed) refuse({point, slowest});
    if (found_.size() == max_places && slowest >= found_.back().feed_m_s) return;
    found_.insert(std::ranges::upper_bound(found_, slowest, {}, &Found::feed_m_s), {point, slowest});
    if (found_.size() > max_places) found_.pop_back();
  }

  SlowPlace describe(const Found& found) const {
    const PlanPath::Edge& edge = path_.edge_to(found.point);
    Eigen::Index joint = 0;
    Configuration turn = path_.configuration(found.point) - path_.configuration(found.point - 1);
    turn = turn.cwiseQuotient(acceleration_).normalized();
    if (found.point + 1 < path_.size()) {
      const Configuration next = path_.configuration(found.point + 1) - path_.configuration(found.point);
      turn -= next.cwiseQuotient(acceleration_).normalized();
    }
    turn.cwiseAbs().maxCoeff(&joint);
    return {edge.keyframe, voxel_at(found.point), path_.header().joints[static_cast<std::size_t>(joint)],
            found.feed_m_s};
  }

  [[noreturn]] void refuse(const Found& found) const {
    const SlowPlace place = describe(found);
    throw InputError("feed_not_kept", "at keyframe " + std::to_string(place.keyframe) + ", voxel (" +
                                          std::to_string(place.voxel.i) + ", " + std::to_string(place.voxel.j) + ", " +
                                          std::to_string(place.voxel.k) + "), joint '" + place.joint + "' lets only " +
                                          text(place.feed_m_s) + " m/s be kept of the " + text(feed_of(found.point)) +
                                          " asked for: ask for --feed " + text(place.feed_m_s / *demands_.keep_feed) +
                                          " at most, or for a smaller --keep-feed than " + text(*demands_.keep_feed));
  }

  const PlanPath& path_;
  const PathTools& tools_;
  const TimeLaw& law_;
  const MotionDemands& demands_;
  const Configuration velocity_, acceleration_;
  std::vector<Found> found_;
};

}  // namespace

std::vector<SlowPlace> find_slow_places(const PlanPath& path, const PathTools& tools, const Configuration& velocity,
                                        const TimeLaw& law, const MotionDemands& demands) {
  return SlowPlaces(path, tools, velocity, law, demands).run();
}

}  // namespace sculpt
