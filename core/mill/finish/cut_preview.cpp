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
  std::vector<std::vector<std::uint32_t>> finished(contours.size());
  run_.helpers.for_each_index(contours.size(),
                              [&](std::size_t contour) { finished[contour] = finished_by(contours[contour]); });
  std::vector<Contour> kept;
  for (std::size_t contour = 0; contour < contours.size(); ++contour) {
    const double path = length_m(contours[contour]) + way_spacings * task_.spacing_m;
    const auto count = std::ranges::count_if(finished[contour], [&](std::uint32_t nail) { return is_open(nail); });
    if (static_cast<double>(count) * nail_m() < least_worth * path) continue;
    for (const std::uint32_t nail : finished[contour]) is_open_[nail] = 0;
    kept.push_back(std::move(contours[contour]));
  }
  return kept;
}

EdgeNails CutPreview::finished_by_edges(const Contour& contour) const {
  if (run_.watch.stop.stop_requested()) throw Cancelled{};
  const auto middle = [&](const Vec3& tip) { return task_.frame.point(tip + Vec3(0, 0, task_.radius_m)); };
  EdgeNails found(contour.size() - 1);
  for (std::size_t edge = 0; edge + 1 < contour.size(); ++edge)
    nails_.for_each_cut(
        middle(contour[edge]), middle(contour[edge + 1]), task_.radius_m - task_.stray_m, reach_.most_left_m(),
        [&](std::uint32_t nail) { return is_open(nail); },
        [&](std::uint32_t nail, double left) {
          if (!reach_.is_open(nail, left)) found[edge].push_back(nail);
        });
  return found;
}

std::vector<std::uint32_t> CutPreview::finished_by(const Contour& contour) const {
  std::vector<std::uint32_t> nails;
  for (const auto& of_edge : finished_by_edges(contour)) nails.insert(nails.end(), of_edge.begin(), of_edge.end());
  std::ranges::sort(nails);
  nails.erase(std::unique(nails.begin(), nails.end()), nails.end());
  return nails;
}

}  // namespace sculpt
