#include "core/mill/finish/tour/trimmed_ends.hpp"

#include <algorithm>

namespace sculpt {
namespace {

/// Where one end was trimmed another contour may be needed no less.
constexpr int rounds = 2;

class EndTrimmer {
 public:
  EndTrimmer(const TrimTask& task, const std::vector<ContourSteps>& tour, const std::vector<EdgeNails>& finished)
      : task_(task), tour_(tour), finished_(finished), steps_that_finish_(task.nails) {
    for (const ContourSteps& steps : tour) left_.push_back({0, steps.places.size() - 1});
    for (const EdgeNails& steps : finished)
      for (const auto& nails : steps)
        for (const std::uint32_t nail : nails) ++steps_that_finish_[nail];
  }

  std::vector<StepSpan> run() {
    for (int round = 0; round < rounds; ++round)
      for (std::size_t contour = 0; contour < tour_.size(); ++contour) {
        left_[contour].first = trimmed(contour, true);
        left_[contour].last = trimmed(contour, false);
      }
    return std::move(left_);
  }

 private:
  /// Of an end, from where on a contour is worth it.
  std::size_t trimmed(std::size_t contour, bool is_begin) {
    const Contour& places = tour_[contour].places;
    const StepSpan& span = left_[contour];
    const auto place = [&](std::size_t taken) { return is_begin ? span.first + taken : span.last - taken; };
    const auto nails = [&](std::size_t taken) -> const auto& {
      return finished_[contour][is_begin ? place(taken) : place(taken) - 1];
    };
    const double whole_way = way_to(contour, is_begin, places[place(0)]);
    double length = 0, forgone = 0, most = 0;
    std::size_t best = 0, taken = 0;
    while (taken + 1 < span.last - span.first) {
      length += (places[place(taken + 1)] - places[place(taken)]).norm();
      for (const std::uint32_t nail : nails(taken))
        if (--steps_that_finish_[nail] == 0) forgone += task_.nail_worth_m;
      ++taken;
      const double won = length + whole_way - way_to(contour, is_begin, places[place(taken)]) - forgone;
      if (won > most) most = won, best = taken;
    }
    best -= std::min(best, task_.spare_steps);
    while (taken > best)
      for (const std::uint32_t nail : nails(--taken)) ++steps_that_finish_[nail];
    return place(best);
  }

  /// From the end of the one before it, or to the beginning of the next.
  double way_to(std::size_t contour, bool is_begin, const Vec3& end) const {
    if (contour == (is_begin ? 0 : tour_.size() - 1)) return 0;
    const std::size_t other = is_begin ? contour - 1 : contour + 1;
    return std::min(task_.far_m, (tour_[other].places[is_begin ? left_[other].last : left_[other].first] - end).norm());
  }

  TrimTask task_;
  const std::vector<ContourSteps>& tour_;
  const std::vector<EdgeNails>& finished_;
  std::vector<std::uint32_t> steps_that_finish_;  ///< each nail, of what is left
  std::vector<StepSpan> left_;
};

}  // namespace

std::vector<StepSpan> trim_ends(const TrimTask& task, const std::vector<ContourSteps>& tour,
                                const std::vector<EdgeNails>& finished) {
  return EndTrimmer(task, tour, finished).run();
}

}  // namespace sculpt
