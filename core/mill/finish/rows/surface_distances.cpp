#include "core/mill/finish/rows/surface_distances.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

namespace sculpt {
namespace {

constexpr float unknown = std::numeric_limits<float>::infinity();
constexpr int most_reductions = 64;

using Offset = std::array<int, 2>;

/// A symmetric matrix D as the sum of weight * offset * offset^T.
struct Stencil {
  std::array<Offset, 3> offsets{};
  std::array<float, 3> weights{};
};

/// By Selling's algorithm: a superbase of the lattice that is obtuse with regard to D.
Stencil stencil_of(const Eigen::Matrix2d& d) {
  std::array<Eigen::Vector2d, 3> base{Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1), Eigen::Vector2d(-1, -1)};
  const auto product = [&](std::size_t i, std::size_t j) { return base[i].dot(d * base[j]); };
  for (int turn = 0; turn < most_reductions; ++turn) {
    std::size_t i = 0;
    while (i < 3 && product(i, (i + 1) % 3) <= 1e-12 * d.trace()) ++i;
    if (i == 3) break;
    base[(i + 2) % 3] = base[i] - base[(i + 1) % 3];
    base[i] = -base[i];
  }
  Stencil stencil;
  for (std::size_t i = 0; i < 3; ++i) {
    stencil.weights[i] = static_cast<float>(std::max(0.0, -product((i + 1) % 3, (i + 2) % 3)));
    stencil.offsets[i] = {-static_cast<int>(base[i].y()), static_cast<int>(base[i].x())};
  }
  return stencil;
}

/// Of the metric I + g g^T of a surface with slope g.
Eigen::Matrix2d inverse_metric(const Point2& slope) {
  return Eigen::Matrix2d::Identity() - slope * slope.transpose() / (1 + slope.squaredNorm());
}

class Marching {
 public:
  Marching(const PlanPatch& patch, const std::vector<char>& is_source)
      : patch_(patch), stencils_(patch.lattice.size()), distances_(patch.lattice.size()), is_known_(is_source) {
    for (std::size_t cell = 0; cell < distances_.size(); ++cell) {
      if (is_source[cell] != 0) continue;
      distances_[cell] = unknown;
      const Point2 slope = patch.is_inside[cell] != 0 ? patch.slopes[cell] : Point2(0, 0);
      stencils_[cell] = stencil_of(inverse_metric(slope));
    }
    find_users();
  }

  std::vector<float> run() {
    for (int b = 0; b < patch_.lattice.height; ++b)
      for (int a = 0; a < patch_.lattice.width; ++a) look(a, b);
    while (!next_.empty()) {
      const Next next = next_.top();
      next_.pop();
      const std::size_t cell = patch_.lattice.index(next.a, next.b);
      if (is_known_[cell] != 0) continue;
      is_known_[cell] = 1;
      for (std::uint32_t at = users_begin_[cell]; at < users_begin_[cell + 1]; ++at) {
        const auto user = static_cast<int>(users_[at]);
        look(user % patch_.lattice.width, user / patch_.lattice.width);
      }
    }
    return std::move(distances_);
  }

 private:
  struct Next {
    float distance;
    int a, b;
    bool operator<(const Next& other) const { return distance > other.distance; }
  };

  void find_users() {
    users_begin_.assign(distances_.size() + 1, 0);
    for_each_use([&](std::size_t, std::size_t used) { ++users_begin_[used + 1]; });
    std::partial_sum(users_begin_.begin(), users_begin_.end(), users_begin_.begin());
    users_.resize(users_begin_.back());
    std::vector<std::uint32_t> next(users_begin_.begin(), users_begin_.end() - 1);
    for_each_use([&](std::size_t user, std::size_t used) { users_[next[used]++] = static_cast<std::uint32_t>(user); });
  }
  /// Calls `visit(cell, used)` for each cell that is to be known and each one that its stencil has.
  template <typename Visit>
  void for_each_use(const Visit& visit) const {
    const Lattice& lattice = patch_.lattice;
    for (std::size_t cell = 0; cell < lattice.size(); ++cell) {
      if (is_known_[cell] != 0) continue;
      const int a = static_cast<int>(cell) % lattice.width, b = static_cast<int>(cell) / lattice.width;
      for (const auto& [da, db] : stencils_[cell].offsets)
        for (const int way : {1, -1})
          if (lattice.contains(a + way * da, b + way * db)) visit(cell, lattice.index(a + way * da, b + way * db));
    }
  }

  void look(int a, int b) {
    const std::size_t cell = patch_.lattice.index(a, b);
    if (is_known_[cell] != 0) return;
    const float distance = solve(a, b);
    if (distance >= distances_[cell]) return;
    distances_[cell] = distance;
    next_.push({distance, a, b});
  }

  float known(int a, int b) const {
    if (!patch_.lattice.contains(a, b)) return unknown;
    const std::size_t cell = patch_.lattice.index(a, b);
    return is_known_[cell] != 0 ? distances_[cell] : unknown;
  }

  /// Sum over the offsets of weight * max(0, d - the lesser of both neighbours)^2 = step^2.
  float solve(int a, int b) const {
    const Stencil& stencil = stencils_[patch_.lattice.index(a, b)];
    std::array<std::pair<double, double>, 3> terms;  // the neighbour's distance, the weight
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& [da, db] = stencil.offsets[i];
      terms[i] = {std::min(known(a + da, b + db), known(a - da, b - db)), stencil.weights[i]};
    }
    std::ranges::sort(terms);
    double least = unknown, square = 0, linear = 0, constant = -patch_.lattice.step * patch_.lattice.step;
    for (const auto& [distance, weight] : terms) {
      if (distance >= least) break;
      square += weight;
      linear += weight * distance;
      constant += weight * distance * distance;
      const double root = linear * linear - square * constant;
      if (square > 0 && root >= 0) least = (linear + std::sqrt(root)) / square;
    }
    return static_cast<float>(least);
  }

  const PlanPatch& patch_;
  std::vector<Stencil> stencils_;
  std::vector<float> distances_;
  std::vector<char> is_known_;
  std::vector<std::uint32_t> users_, users_begin_;  ///< of each cell those whose stencils have it
  std::priority_queue<Next> next_;
};

}  // namespace

std::vector<float> surface_distances(const PlanPatch& patch, const std::vector<char>& is_source) {
  return Marching(patch, is_source).run();
}

}  // namespace sculpt
