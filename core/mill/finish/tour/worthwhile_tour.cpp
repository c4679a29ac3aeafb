#include "core/mill/finish/tour/worthwhile_tour.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "core/mill/finish/tour/contour_steps.hpp"
#include "core/mill/finish/tour/profitable_tour.hpp"
#include "core/mill/finish/tour/tour.hpp"
#include "core/mill/finish/tour/trimmed_ends.hpp"

namespace sculpt {
namespace {

/// All in row spacings. Contours no farther apart may be gone over to in the middle; and ways longer than so many are
/// no dearer.
constexpr double near = 6, far = 60;
/// What is worth it is found out step by step.
constexpr double step = 0.25;
constexpr std::size_t spare_steps = 2;
/// Among those that are kept of a tour there is a shorter one.
constexpr int tours_made = 2;

/// Of each contour how many nails it finishes, those not counted that one before it finishes.
std::vector<std::size_t> count_finished(const std::vector<EdgeNails>& finished, std::size_t nails) {
  std::vector<char> is_seen(nails);
  std::vector<std::size_t> counts;
  counts.reserve(finished.size());
  for (const EdgeNails& steps : finished) {
    counts.push_back(0);
    for (const auto& step_nails : steps)
      for (const std::uint32_t nail : step_nails) counts.back() += std::exchange(is_seen[nail], 1) == 0 ? 1 : 0;
  }
  return counts;
}

class TourMaker {
 public:
  TourMaker(const TourTask& task, const CutPreview& preview, const RunContext& run)
      : task_(task), preview_(preview), run_(run), nail_worth_m_(task.worth * preview.nail_m()) {}

  /// A tour of what is worth it among these.
  WorthwhileTour make(const std::vector<Contour>& contours) const {
    const std::vector<Contour> tour = tour_of(contours, near * task_.spacing_m);
    std::vector<ContourSteps> steps(tour.size());
    std::vector<EdgeNails> finished(tour.size());
    run_.helpers.for_each_index(tour.size(), [&](std::size_t contour) {
      steps[contour] = in_steps(tour[contour], step * task_.spacing_m);
      finished[contour] = preview_.finished_by_edges(steps[contour].places);
    });
    std::vector<double> worth_m;
    for (const std::size_t count : count_finished(finished, preview_.nails()))
      worth_m.push_back(nail_worth_m_ * static_cast<double>(count));
    std::vector<ContourSteps> kept_steps;
    std::vector<EdgeNails> kept_finished;
    for (const std::size_t contour : profitable(tour, worth_m, far * task_.spacing_m)) {
      kept_steps.push_back(std::move(steps[contour]));
      kept_finished.push_back(std::move(finished[contour]));
    }
    return made_of(kept_steps, spans_of(kept_steps, kept_finished), kept_finished);
  }

 private:
  std::vector<StepSpan> spans_of(const std::vector<ContourSteps>& steps, const std::vector<EdgeNails>& finished) const {
    if (task_.is_trimmed)
      return trim_ends({preview_.nails(), nail_worth_m_, far * task_.spacing_m, spare_steps}, steps, finished);
    std::vector<StepSpan> whole;
    whole.reserve(steps.size());
    for (const ContourSteps& each : steps) whole.push_back({0, each.places.size() - 1});
    return whole;
  }

  WorthwhileTour made_of(const std::vector<ContourSteps>& steps, const std::vector<StepSpan>& spans,
                         const std::vector<EdgeNails>& finished) const {
    WorthwhileTour made;
    made.contours.resize(steps.size());
    run_.helpers.for_each_index(steps.size(), [&](std::size_t number) {
      made.contours[number] = part_of(steps[number], spans[number], task_.envelope);
    });
    made.finishes.resize(preview_.nails());
    for (std::size_t number = 0; number < steps.size(); ++number)
      for (std::size_t step = spans[number].first; step < spans[number].last; ++step)
        for (const std::uint32_t nail : finished[number][step]) made.finishes[nail] = 1;
    return made;
  }

  const TourTask& task_;
  const CutPreview& preview_;
  const RunContext& run_;
  double nail_worth_m_;
};

}  // namespace

WorthwhileTour worthwhile_tour(const TourTask& task, std::vector<Contour> contours, const CutPreview& preview,
                               const RunContext& run) {
  const TourMaker maker(task, preview, run);
  WorthwhileTour made{std::move(contours), {}};
  for (int time = 0; time < tours_made; ++time) made = maker.make(made.contours);
  return made;
}

}  // namespace sculpt
