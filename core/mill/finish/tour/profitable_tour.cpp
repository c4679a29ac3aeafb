#include "core/mill/finish/tour/profitable_tour.hpp"

#include <algorithm>
#include <limits>

namespace sculpt {
namespace {

/// The best of all choices among the contours up to one that keep it. Number 0 is the start: contour n has n + 1.
struct Choice {
  double cost_m = 0;  ///< ways, lengths, and what is forgone
  std::size_t before = 0;
  double least_m = 0;  ///< of this one and all before it, the lowest cost less all that is worth anything up to there
};

class Chooser {
 public:
  Chooser(const std::vector<Contour>& tour, const std::vector<double>& worth_m, double far_m)
      : tour_(tour), far_m_(far_m), end_(tour.size() + 1), worth_before_(end_ + 2), choices_(end_ + 1) {
    for (std::size_t number = 1; number < end_; ++number)
      worth_before_[number + 1] = worth_before_[number] + worth_m[number - 1];
    worth_before_[end_ + 1] = worth_before_[end_];
  }

  std::vector<std::size_t> run() {
    for (std::size_t to = 1; to <= end_; ++to) choose(to);
    std::vector<std::size_t> kept;
    for (std::size_t number = choices_[end_].before; number > 0; number = choices_[number].before)
      kept.push_back(number - 1);
    std::ranges::reverse(kept);
    return kept;
  }

 private:
  double way(std::size_t from, std::size_t to) const {
    if (from == 0 && to == end_) return 0;
    if (from == 0 || to == end_) return far_m_ / 2;
    return std::min(far_m_, (tour_[from - 1].back() - tour_[to - 1].front()).norm());
  }

  /// What is worth anything between two that are kept one after the other is forgone.
  void choose(std::size_t to) {
    Choice& choice = choices_[to];
    choice.cost_m = std::numeric_limits<double>::infinity();
    const double own = worth_before_[to] + (to < end_ ? length_m(tour_[to - 1]) : 0);
    for (std::size_t from = to; from-- > 0;) {
      // Nothing before it is better.
      if (choices_[from].least_m + own >= choice.cost_m) break;
      const double cost = choices_[from].cost_m + way(from, to) + own - worth_before_[from + 1];
      if (cost < choice.cost_m) choice.cost_m = cost, choice.before = from;
    }
    choice.least_m = std::min(choices_[to - 1].least_m, choice.cost_m - worth_before_[to + 1]);
  }

  const std::vector<Contour>& tour_;
  double far_m_;
  std::size_t end_;
  std::vector<double> worth_before_;  ///< of each number what those before it are worth
  std::vector<Choice> choices_;
};

}  // namespace

std::vector<std::size_t> profitable(const std::vector<Contour>& tour, const std::vector<double>& worth_m,
                                    double far_m) {
  return Chooser(tour, worth_m, far_m).run();
}

}  // namespace sculpt
