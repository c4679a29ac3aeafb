#include "core/mill/finish/rows/plan_patch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sculpt {
namespace {

constexpr int cells_around = 3;

Lattice lattice_around(const std::vector<RestingBall>& balls, double reach_m, double step_m) {
  Eigen::AlignedBox2d box;
  for (const RestingBall& ball : balls) box.extend(Point2(ball.middle.head<2>()));
  const double margin = reach_m + cells_around * step_m;
  const Point2 low = box.min() - Point2::Constant(margin), size = box.sizes() + Point2::Constant(2 * margin);
  return {low.x(), low.y(), step_m, static_cast<int>(size.x() / step_m) + 1, static_cast<int>(size.y() / step_m) + 1};
}

/// Of the ball that is nearest to a cell.
struct NearestBall {
  double distance2 = std::numeric_limits<double>::infinity(), height = 0;  ///< m2, m
  Point2 slope = Point2::Zero();
};

class Splatter {
 public:
  Splatter(const PatchTask& task, const Lattice& lattice) : task_(task), lattice_(lattice), nearest_(lattice.size()) {}

  void add(const Vec3& middle, const Vec3& normal) {
    const Point2 slope = -normal.head<2>() / std::max(normal.z(), task_.least_cosine);
    const double reach = task_.reach_m;
    const int own_a = lattice_.cell_u(middle.x()), own_b = lattice_.cell_v(middle.y());
    for (int b = lattice_.cell_v(middle.y() - reach); b <= lattice_.cell_v(middle.y() + reach); ++b)
      for (int a = lattice_.cell_u(middle.x() - reach); a <= lattice_.cell_u(middle.x() + reach); ++a) {
        const Point2 off(lattice_.u(a) - middle.x(), lattice_.v(b) - middle.y());
        const double up = slope.dot(off), distance2 = off.squaredNorm() + up * up;
        if (distance2 > reach * reach && (a != own_a || b != own_b)) continue;
        NearestBall& nearest = nearest_[lattice_.index(a, b)];
        if (distance2 < nearest.distance2) nearest = {distance2, middle.z() + up, slope};
      }
  }

  PlanPatch take() const {
    PlanPatch patch{lattice_, std::vector<char>(lattice_.size()), std::vector<Point2>(lattice_.size(), Point2::Zero())};
    for (std::size_t cell = 0; cell < nearest_.size(); ++cell) {
      patch.is_inside[cell] = has_ball(cell);
      patch.slopes[cell] = nearest_[cell].slope;
    }
    end_at_jumps(patch.is_inside);
    return patch;
  }

 private:
  /// The lower surface ends there.
  void end_at_jumps(std::vector<char>& is_inside) const {
    for (int b = 0; b + 1 < lattice_.height; ++b)
      for (int a = 0; a + 1 < lattice_.width; ++a) {
        const std::size_t here = lattice_.index(a, b);
        for (const std::size_t there : {lattice_.index(a + 1, b), lattice_.index(a, b + 1)})
          if (jumps(here, there)) is_inside[nearest_[here].height < nearest_[there].height ? here : there] = 0;
      }
  }
  bool has_ball(std::size_t cell) const { return std::isfinite(nearest_[cell].distance2); }
  bool jumps(std::size_t a, std::size_t b) const {
    return has_ball(a) && has_ball(b) && std::abs(nearest_[a].height - nearest_[b].height) > task_.jump_m;
  }

  const PatchTask& task_;
  Lattice lattice_;
  std::vector<NearestBall> nearest_;
};

}  // namespace

PlanPatch make_patch(const PatchTask& task, const ToolFrame& frame, const Nails& nails,
                     const std::vector<RestingBall>& balls) {
  if (balls.empty()) return {};
  Splatter splatter(task, lattice_around(balls, task.reach_m, task.step_m));
  for (const RestingBall& ball : balls) splatter.add(ball.middle, frame.of(nails[ball.nail].normal));
  return splatter.take();
}

}  // namespace sculpt
