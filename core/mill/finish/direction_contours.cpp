#include "core/mill/finish/direction_contours.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/mill/finish/rows/middle_curves.hpp"
#include "core/mill/finish/rows/offset_curves.hpp"
#include "core/mill/finish/rows/parallel_curves.hpp"
#include "core/mill/finish/rows/plan_patch.hpp"

namespace sculpt {
namespace {

/// Where lines are looked for that leans more counts as leaning so.
constexpr double steepest_line_cosine = 0.15;
/// All in row spacings. Cells of patches:
constexpr double cell = 0.25;
/// How far a patch goes beyond its outermost balls: of rings, of rows side by side, and of lines.
constexpr double ring_reach = 1, row_reach = 0.75, line_reach = 0.8;
/// Of the rectangle around it: what fills more has rows side by side, which leave the same everywhere; rings leave more
/// where they turn sharply, and where they meet.
constexpr double filled_share = 0.6;
/// The first ring is so far inside of the outermost balls.
constexpr double first_ring = 0.5;
/// Where one surface is so far behind another a patch ends.
constexpr double jump = 3;
/// Around nails that are asked for it is looked whether any other is left.
constexpr double look_between = 2;
/// How often lines are laid through what is left.
constexpr int lines_laid = 2;
/// Rows whose ends are no farther apart go on as one.
constexpr double joined_m = 1e-9;

}  // namespace

DirectionContours::DirectionContours(const DirectionTask& task, NailReach& reach, Carver& carver, const RunContext& run)
    : task_(task), reach_(reach), carver_(carver), nails_(carver.nails()), run_(run), preview_(preview()) {}

CutPreview DirectionContours::preview() const {
  return {{task_.site.frame(), task_.envelope.radius_m, task_.stray_m, task_.spacing_m}, reach_, nails_, run_};
}

WorthwhileTour DirectionContours::run(const std::vector<std::uint32_t>& wanted) {
  for (const std::uint32_t nail : wanted)
    if (!reach_.is_beside(nail)) balls_.push_back(resting(nail));
  lay(rows());
  lay(rows_by_walls(), 0);
  if (task_.is_last)
    add_beside(wanted);
  else
    add_between(wanted);
  for (int time = 0; time < lines_laid; ++time) lay(middle_lines());
  return worthwhile_tour({task_.spacing_m, task_.worth, task_.is_trimmed, task_.envelope}, std::move(contours_),
                         preview(), run_);
}

RestingBall DirectionContours::resting(std::uint32_t nail) const {
  return {nail, reach_.middle_over(nail, task_.site.frame()), reach_.is_beside(nail)};
}

/// In creases.
void DirectionContours::add_beside(const std::vector<std::uint32_t>& wanted) {
  for (const std::uint32_t nail : wanted)
    if (reach_.is_beside(nail)) balls_.push_back(resting(nail));
}

/// A large tool asks few nails; between rows others may be left, each of which a small tool would have to go to.
void DirectionContours::add_between(const std::vector<std::uint32_t>& wanted) {
  std::vector<char> is_seen(nails_.size());
  for (const RestingBall& ball : balls_) is_seen[ball.nail] = 1;
  std::vector<std::uint32_t> more;
  for (const std::uint32_t nail : wanted)
    nails_.for_each_near(nails_[nail].point, look_between * task_.spacing_m, [&](std::uint32_t other) {
      if (is_seen[other] != 0 || (nails_[other].point - nails_[nail].point).norm() > look_between * task_.spacing_m)
        return;
      is_seen[other] = 1;
      if (preview_.is_open(other) && cosine(other) >= wall_cosine) more.push_back(other);
    });
  for (const std::uint32_t nail : reach_.come_to(more, task_.direction))
    if (carver_.reach().allows(reach_.tip_at(nail, task_.site.frame()))) balls_.push_back(resting(nail));
}

std::vector<Curve> DirectionContours::rows() const {
  std::vector<RestingBall> balls;
  std::ranges::copy_if(balls_, std::back_inserter(balls),
                       [&](const RestingBall& ball) { return cosine(ball.nail) >= wall_cosine; });
  const double s = task_.spacing_m;
  const auto patch = [&](double reach) {
    return make_patch({cell * s, reach * s, jump * s, wall_cosine}, task_.site.frame(), nails_, balls);
  };
  const PlanPatch wide = patch(ring_reach);
  const auto filled = static_cast<double>(std::ranges::count(wide.is_inside, 1));
  if (filled > filled_share * static_cast<double>(wide.is_inside.size()))
    return parallel_curves(patch(row_reach), row_reach * s, s, wide.lattice.width > wide.lattice.height);
  return offset_curves(wide, (ring_reach + first_ring) * s, s, run_.helpers);
}

std::vector<Row> DirectionContours::rows_by_walls() const {
  std::vector<RestingBall> balls;
  std::ranges::copy_if(balls_, std::back_inserter(balls),
                       [&](const RestingBall& ball) { return cosine(ball.nail) < wall_cosine; });
  return wall_rows({task_.spacing_m, task_.time, task_.envelope.radius_m, reach_.area_m2()}, task_.site.frame(), nails_,
                   balls);
}

std::vector<Curve> DirectionContours::middle_lines() const {
  std::vector<Point2> exact;
  for (const RestingBall& ball : balls_)
    if (ball.is_beside) exact.emplace_back(ball.middle.head<2>());
  const double s = task_.spacing_m;
  return middle_curves(
      make_patch({cell * s, line_reach * s, jump * s, steepest_line_cosine}, task_.site.frame(), nails_, balls_), exact,
      s);
}

void DirectionContours::lay(const std::vector<Curve>& curves) {
  std::vector<Row> rows;
  for (const Curve& curve : curves)
    for (std::size_t at = 0; at + 1 < curve.size(); ++at) rows.push_back({curve[at], curve[at + 1], {}});
  lay(rows, task_.least_worth);
}

void DirectionContours::lay(const std::vector<Row>& rows, double least_worth) {
  std::ranges::move(preview_.cut(follow(rows), least_worth), std::back_inserter(contours_));
  std::erase_if(balls_, [&](const RestingBall& ball) { return !preview_.is_open(ball.nail); });
}

std::vector<Contour> DirectionContours::follow(const std::vector<Row>& rows) const {
  std::vector<std::vector<Contour>> found(rows.size());
  run_.helpers.for_each_index(rows.size(), [&](std::size_t row) {
    if (run_.watch.stop.stop_requested()) throw Cancelled{};
    found[row] = follow_envelope(task_.envelope, rows[row].from, rows[row].to, rows[row].stops);
  });
  std::vector<Contour> contours;
  for (auto& each : found)
    for (Contour& contour : each)
      if (!contours.empty() && (contours.back().back() - contour.front()).norm() < joined_m)
        contours.back().insert(contours.back().end(), contour.begin() + 1, contour.end());
      else
        contours.push_back(std::move(contour));
  return contours;
}

}  // namespace sculpt
