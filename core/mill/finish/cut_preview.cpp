#include "core/mill/finish/cut_preview.hpp"

#include <algorithm>

namespace sculpt {
namespace {

/// Spacings to a contour from the one before it.
constexpr double way_spacings = 3;

}  // namespace

std::vector<Contour> CutPreview::cut(std::vector<Contour> contours, double least_worth) {
  std::erase_if(contours, [&](const Contour& contour) { return !is_worth_it(contour, least_worth); });
  return contours;
}

/// If it is not, all is as before.
bool CutPreview::is_worth_it(const Contour& contour, double least_worth) {
  const auto middle = [&](const Vec3& tip) { return task_.frame.point(tip + Vec3(0, 0, task_.radius_m)); };
  changes_.clear();
  double length = 0;
  for (std::size_t edge = 0; edge + 1 < contour.size(); ++edge) {
    length += (contour[edge + 1] - contour[edge]).norm();
    nails_.cut(middle(contour[edge]), middle(contour[edge + 1]), task_.radius_m - task_.stray_m, excesses_, changes_);
  }
  const auto finished = std::ranges::count_if(changes_, [&](const Nails::Change& change) {
    return reach_.is_open(change.nail, static_cast<double>(change.before)) &&
           !reach_.is_open(change.nail, static_cast<double>(change.after));
  });
  const double served_m = static_cast<double>(finished) * nails_.area_m2() / task_.spacing_m;
  if (served_m >= least_worth * (length + way_spacings * task_.spacing_m)) return true;
  for (auto change = changes_.rbegin(); change != changes_.rend(); ++change) excesses_[change->nail] = change->before;
  return false;
}

}  // namespace sculpt
