#include "core/doctor/find_home.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "core/base/random.hpp"
#include "core/cell/ik.hpp"
#include "core/doctor/probe_reach.hpp"
#include "core/motion/random_configuration.hpp"
#include "core/trajectory/quantum.hpp"

namespace sculpt {
namespace {

constexpr int guesses = 80, wild_guesses = 3000;
constexpr std::size_t enough_candidates = 8;
constexpr double short_values = 1e4;               // rounded to the inverse of it
constexpr double wide_m = 0.02;                    // more clearance than this is worth nothing
constexpr double wide_margin = 0.25;               // nor is more margin to limits
constexpr double same_rad = 0.3;                   // candidates that are nearer count as one
constexpr std::array lifts{0.25, 0.1, 0.5, 0.05};  // of the ball above the stock, in its edges

/// Upright, then leaning by 45 degrees to the eight sides.
std::vector<Vec3> axes_down() {
  std::vector<Vec3> axes{Vec3::UnitZ()};
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      if (x != 0 || y != 0) axes.push_back((Vec3(x, y, 0).normalized() + Vec3::UnitZ()).normalized());
  return axes;
}

class HomeSearch {
 public:
  HomeSearch(const Scene& scene, const Configuration& start, const RunContext& run)
      : scene_(scene), run_(run), random_(mix(run.seed, 0x686f6d65)), group_(rigid_groups(scene.chain().robot())) {
    for (const Joint& joint : scene.chain().robot().joints)
      joined_.insert(std::minmax(group(joint.parent_link), group(joint.child_link)));
    starts_.push_back(start);
    for (int guess = 0; guess < guesses; ++guess) starts_.push_back(random_configuration(scene.chain(), random_));
  }

  std::optional<Home> run() {
    const std::vector<Vec3> axes = axes_down();
    for (std::size_t axis = 0; axis < axes.size(); ++axis) {
      for (const double lift : lifts) {
        look_along(axes[axis], lift);
        if (found_.size() >= enough_candidates) break;
      }
      if (!found_.empty() && (axis == 0 || axis + 1 == axes.size())) return best();
    }
    look_anywhere();
    return best();
  }

 private:
  int group(int link) const { return group_[static_cast<std::size_t>(link)]; }
  const Chain& chain() const { return scene_.chain(); }
  double edge_m() const { return scene_.grid().n * scene_.grid().voxel_m; }

  void look_along(const Vec3& axis, double lift) {
    const double edge = edge_m();
    const double above_m = std::max(lift * edge, 2 * scene_.grid().voxel_m);
    const Vec3 ball = scene_.grid().origin_m + Vec3(edge / 2, edge / 2, edge + above_m);
    for (const Configuration& start : starts_) {
      run_.watch.step(Stage::plan, 0, 0);
      if (const auto q = solve_ik(chain(), {ball, axis}, start)) consider(*q);
      if (found_.size() >= enough_candidates) return;
    }
  }

  void look_anywhere() {
    const double top = scene_.grid().origin_m.z() + edge_m();
    for (int guess = 0; guess < wild_guesses && found_.size() < enough_candidates; ++guess) {
      run_.watch.step(Stage::plan, 0, 0);
      const Configuration q = random_configuration(chain(), random_);
      if (chain().tool_pose(q).ball_m.z() > top) consider(q);
    }
  }

  void consider(const Configuration& solved) {
    const Configuration q = shortened(solved);
    const bool known = std::any_of(found_.begin(), found_.end(),
                                   [&](const Home& other) { return (other.q - q).cwiseAbs().maxCoeff() < same_rad; });
    if (known || scene_.contact_at(q) != Contact::none) return;
    found_.push_back({q, clearance_m(q), limit_margin(q), 0});
  }

  /// With values as a person would write them, where the limits allow it.
  Configuration shortened(const Configuration& q) const {
    const Configuration brief = (q * short_values).array().round() / short_values + 0.0;  // no -0
    return chain().within_limits(brief) ? brief : rounded(q, chain().lower(), chain().upper());
  }

  bool are_neighbours(const NearBodies& near) const {
    return near.first >= 0 && near.second >= 0 && joined_.count(std::minmax(group(near.first), group(near.second))) > 0;
  }

  double clearance_m(const Configuration& q) const {
    double least = wide_m;
    for (const NearBodies& near : scene_.near_bodies(q, wide_m))
      if (!are_neighbours(near)) least = std::min(least, near.gap_m);
    return least;
  }

  double limit_margin(const Configuration& q) const {
    double least = 1;
    for (Eigen::Index c = 0; c < q.size(); ++c) {
      const double low = chain().lower()[c], high = chain().upper()[c];
      least = std::min(least, 2 * std::min(q[c] - low, high - q[c]) / (high - low));
    }
    return least;
  }

  /// How near the joints are to the middle of their ranges, on average: 1 in it.
  double centredness(const Configuration& q) const {
    const Configuration middle = (chain().lower() + chain().upper()) / 2,
                        half = (chain().upper() - chain().lower()) / 2;
    return 1 - ((q - middle).array() / half.array()).abs().mean();
  }

  double worth(const Home& home) const {
    return home.reach + 0.1 * home.clearance_m / wide_m + 0.1 * std::min(home.limit_margin, wide_margin) / wide_margin +
           0.2 * centredness(home.q);
  }

  std::optional<Home> best() {
    if (found_.empty()) return std::nullopt;
    run_.helpers.for_each_index(
        found_.size(), [&](std::size_t at) { found_[at].reach = probe_reach(scene_, found_[at].q, run_.watch); });
    return *std::max_element(found_.begin(), found_.end(),
                             [this](const Home& a, const Home& b) { return worth(a) < worth(b); });
  }

  const Scene& scene_;
  const RunContext& run_;
  Random random_;
  const std::vector<int> group_;
  std::set<std::pair<int, int>> joined_;  // groups across one joint
  std::vector<Configuration> starts_;
  std::vector<Home> found_;
};

}  // namespace

std::optional<Home> find_home(const Scene& scene, const Configuration& start, const RunContext& run) {
  return HomeSearch(scene, start, run).run();
}

}  // namespace sculpt
