#include "core/mill/finish/rows/surface_distances.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <queue>
#include <utility>

namespace sculpt {
namespace {

constexpr float unknown = std::numeric_limits<float>::infinity();
/// No offset of a stencil is longer along u or v; slopes are bounded.
constexpr int longest_offset = 6;
constexpr int most_reductions = 64;

using Offset = std::array<int, 2>;

/// A symmetric matrix D as the sum of weight * offset * offset^T.
struct Stencil {
  std::array<Offset, 3> offsets{};
  std::array<float, 3> weights{};

  bool has(int da, int db) const {
    return std::ranges::any_of(
        offsets, [&](const Offset& o) { return (o[0] == da && o[1] == db) || (o[0] == -da && o[1] == -db); });
  }
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
      look_around(next.a, next.b);
    }
    return std::move(distances_);
  }

 private:
  struct Next {
    float distance;
    int a, b;
    bool operator<(const Next& other) const { return distance > other.distance; }
  };

  /// At those whose stencils have this cell.
  void look_around(int a, int b) {
    for (int db = -longest_offset; db <= longest_offset; ++db)
      for (int da = -longest_offset; da <= longest_offset; ++da)
        if (patch_.lattice.contains(a + da, b + db) && stencils_[patch_.lattice.index(a + da, b + db)].has(da, db))
          look(a + da, b + db);
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
  std::priority_queue<Next> next_;
};

}  // namespace

std::vector<float> surface_distances(const PlanPatch& patch, const std::vector<char>& is_source) {
  return Marching(patch, is_source).run();
}

}  // namespace sculpt
