#include "core/mill/finish/tour/trimmed_ends.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

constexpr double far = 60;

/// From (x, y) on along x, in steps of 1.
ContourSteps make_line(double x, double y, int steps) {
  return in_steps({Vec3(x, y, 0), Vec3(x + steps, y, 0)}, 1.001);
}

struct Tour {
  std::vector<ContourSteps> contours;
  std::vector<EdgeNails> finished;
  std::size_t nails = 0;
};

/// Of some lines, each step of which finishes a few nails of its own and of all.
Tour make_tour(Random& random) {
  Tour tour;
  tour.nails = 60;
  for (int contour = 0; contour < 5; ++contour) {
    const int steps = 1 + static_cast<int>(random.between(0, 9));
    tour.contours.push_back(make_line(random.between(0, 10), random.between(0, 10), steps));
    tour.finished.emplace_back(steps);
    for (auto& nails : tour.finished.back())
      for (double count = random.between(0, 6); count >= 1; --count)
        nails.push_back(static_cast<std::uint32_t>(random.between(0, 59)));
  }
  return tour;
}

std::set<std::uint32_t> finished_by(const Tour& tour, const std::vector<StepSpan>& spans) {
  std::set<std::uint32_t> nails;
  for (std::size_t contour = 0; contour < spans.size(); ++contour)
    for (std::size_t at = spans[contour].first; at < spans[contour].last; ++at)
      nails.insert(tour.finished[contour][at].begin(), tour.finished[contour][at].end());
  return nails;
}

std::vector<StepSpan> whole(const Tour& tour) {
  std::vector<StepSpan> spans;
  for (const ContourSteps& steps : tour.contours) spans.push_back({0, steps.places.size() - 1});
  return spans;
}

/// The path along some contours and over the ways between them.
double path_m(const Tour& tour, const std::vector<StepSpan>& spans) {
  double sum = 0;
  for (std::size_t contour = 0; contour < spans.size(); ++contour) {
    const Contour& places = tour.contours[contour].places;
    sum += (places[spans[contour].last] - places[spans[contour].first]).norm();
    if (contour > 0)
      sum += std::min(
          far, (places[spans[contour].first] - tour.contours[contour - 1].places[spans[contour - 1].last]).norm());
  }
  return sum;
}

double profit(const Tour& tour, double nail_worth_m, const std::vector<StepSpan>& spans) {
  return nail_worth_m * static_cast<double>(finished_by(tour, spans).size()) - path_m(tour, spans);
}

TEST(TrimmedEnds, GoNoFartherThanWhatNobodyElseFinishes) {
  // Two lines one after the other. The second finishes what the first does in its last two steps.
  const Tour tour{{make_line(0, 0, 5), make_line(3, 1, 5)}, {{{0}, {1}, {2}, {3}, {4}}, {{3}, {4}, {5}, {6}, {6}}}, 7};
  const auto spans = trim_ends({tour.nails, 100, far, 0}, tour.contours, tour.finished);
  EXPECT_EQ(spans[0].first, 0U);
  EXPECT_EQ(spans[0].last, 3U);
  EXPECT_EQ(spans[1].first, 0U);
  EXPECT_EQ(spans[1].last, 4U);
}

TEST(TrimmedEnds, SpareStepsStay) {
  const Tour tour{{make_line(0, 0, 8)}, {{{}, {}, {}, {0}, {0}, {}, {}, {}}}, 1};
  const auto trimmed = [&](std::size_t spare) {
    return trim_ends({tour.nails, 100, far, spare}, tour.contours, tour.finished).front();
  };
  EXPECT_EQ(trimmed(0).last - trimmed(0).first, 1U);
  EXPECT_EQ(trimmed(1).first, 3U);
  EXPECT_EQ(trimmed(9).first, 0U);
  EXPECT_EQ(trimmed(9).last, 8U);
}

TEST(TrimmedEnds, KeepEveryNailThatIsWorthMoreThanAnyPath) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Tour tour = make_tour(random);
    const auto spans = trim_ends({tour.nails, 1e6, far, seed % 3}, tour.contours, tour.finished);
    EXPECT_EQ(finished_by(tour, spans), finished_by(tour, whole(tour)));
  }
}

TEST(TrimmedEnds, WinWhateverANailIsWorth) {
  double won = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Tour tour = make_tour(random);
    const double worth = random.between(0, 3);
    const auto spans = trim_ends({tour.nails, worth, far, 0}, tour.contours, tour.finished);
    for (std::size_t contour = 0; contour < spans.size(); ++contour) {
      EXPECT_LT(spans[contour].first, spans[contour].last);
      EXPECT_LT(spans[contour].last, tour.contours[contour].places.size());
    }
    const double more = profit(tour, worth, spans) - profit(tour, worth, whole(tour));
    EXPECT_GE(more, -1e-9);
    won += more;
  }
  EXPECT_GT(won, 300);
}

}  // namespace
}  // namespace sculpt
