#include "core/mill/finish/cut_preview.hpp"

#include <algorithm>
#include <utility>

#include "core/base/error.hpp"

namespace sculpt {
namespace {

/// Spacings to a contour from the one before it.
constexpr double way_spacings = 3;

}  // namespace

CutPreview::CutPreview(const Task& task, const NailReach& reach, const Nails& nails, const RunContext& run)
    : task_(task), reach_(reach), nails_(nails), run_(run), is_open_(nails.size()) {
  for (std::size_t nail = 0; nail < nails.size(); ++nail) is_open_[nail] = reach.is_open(nail);
}

std::vector<Contour> CutPreview::cut(std::vector<Contour> contours, double least_worth) {
  const auto finished = find_finished(contours);
  std::vector<Contour> kept;
  for (std::size_t contour = 0; contour < contours.size(); ++contour) {
    const double path = length_m(contours[contour]) + way_spacings * task_.spacing_m;
    if (served_m(finished[contour]) < least_worth * path) continue;
    for (const std::uint32_t nail : finished[contour]) is_open_[nail] = 0;
    kept.push_back(std::move(contours[contour]));
  }
  return kept;
}

std::vector<double> CutPreview::served(const std::vector<Contour>& contours) {
  std::vector<double> served;
  served.reserve(contours.size());
  for (const auto& finished : find_finished(contours)) {
    served.push_back(served_m(finished));
    for (const std::uint32_t nail : finished) is_open_[nail] = 0;
  }
  return served;
}

double CutPreview::served_m(const std::vector<std::uint32_t>& finished) const {
  const auto count = std::ranges::count_if(finished, [&](std::uint32_t nail) { return is_open(nail); });
  return static_cast<double>(count) * nails_.area_m2() / task_.spacing_m;
}

/// Of each contour the nails, open until now, that it finishes alone.
std::vector<std::vector<std::uint32_t>> CutPreview::find_finished(const std::vector<Contour>& contours) const {
  std::vector<std::vector<std::uint32_t>> found(contours.size());
  const auto middle = [&](const Vec3& tip) { return task_.frame.point(tip + Vec3(0, 0, task_.radius_m)); };
  run_.helpers.for_each_index(contours.size(), [&](std::size_t number) {
    if (run_.watch.stop.stop_requested()) throw Cancelled{};
    const Contour& contour = contours[number];
    std::vector<std::uint32_t>& nails = found[number];
    for (std::size_t edge = 0; edge + 1 < contour.size(); ++edge)
      nails_.for_each_cut(
          middle(contour[edge]), middle(contour[edge + 1]), task_.radius_m - task_.stray_m, reach_.most_left_m(),
          [&](std::uint32_t nail) { return is_open(nail); },
          [&](std::uint32_t nail, double left) {
            if (!reach_.is_open(nail, left)) nails.push_back(nail);
          });
    std::ranges::sort(nails);
    nails.erase(std::unique(nails.begin(), nails.end()), nails.end());
  });
  return found;
}

}  // namespace sculpt
