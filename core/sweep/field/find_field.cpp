#include "core/sweep/field/find_field.hpp"

#include <algorithm>
#include <numbers>
#include <optional>

#include "core/cell/ik.hpp"
#include "core/motion/random_configuration.hpp"

namespace sculpt {
namespace {

constexpr int random_guesses = 24;
constexpr int max_fields = 3;
constexpr double probe_half = 0.03;  // rad or m: what the joints do within a cell of a field

std::vector<Configuration> find_guesses(const Chain& chain, const Configuration& home,
                                        const std::vector<Configuration>& known, std::uint64_t seed) {
  std::vector<Configuration> guesses{home};
  for (const Configuration& other : known)
    for (Eigen::Index joint = 0; joint < home.size(); ++joint)
      for (int quarters : {1, -1, 2, -2}) {
        Configuration guess = other;
        guess[joint] += quarters * std::numbers::pi / 2;
        if (chain.within_limits(guess)) guesses.push_back(guess);
      }
  Random random(seed);
  for (int guess = 0; guess < random_guesses; ++guess) guesses.push_back(random_configuration(chain, random));
  return guesses;
}

constexpr int probes = 27;

/// At how many of some ball positions all over the grid the arm has room, if it comes there from `start`.
int count_free_probes(const Scene& scene, const ToolView& view, const Configuration& start) {
  const double last = view.n - 1;
  int free = 0;
  for (double a : {0.5, 0.0, 1.0})
    for (double b : {0.5, 0.0, 1.0}) {
      std::optional<Configuration> q = start;
      for (double c : {1.0, 0.5, 0.0}) {
        q = solve_ik(scene.chain(), {view.ball_m(scene.grid(), Vec3(a, b, c) * last), view.axis()}, *q);
        if (!q) break;
        const Configuration half = Configuration::Constant(q->size(), probe_half);
        Scene::Pairs pairs = scene.pairs();
        free += !scene.bubble(*q, {*q - half, *q + half}, {}, pairs).empty();
      }
    }
  return free;
}

/// Grows fields from one start after the other and keeps the best.
class FieldSearch {
 public:
  FieldSearch(const Scene& scene, const ToolView& view, const RunContext& run)
      : scene_(scene), view_(view), run_(run) {}

  std::unique_ptr<PostureField> run(const std::vector<Configuration>& guesses) {
    const double middle = (view_.n - 1) / 2.0;
    const IkGoal above{view_.ball_m(scene_.grid(), {middle, middle, view_.n + 1.0}), view_.axis()};
    for (const Configuration& guess : guesses) {
      if (is_done()) break;
      const auto q = solve_ik(scene_.chain(), above, guess);
      if (!q || is_known(*q) || scene_.contact_at(*q) != Contact::none) continue;
      starts_.push_back({*q, count_free_probes(scene_, view_, *q)});
      if (starts_.back().free == probes) grow(*q);
    }
    // None has room everywhere, or those that do lead nowhere: the most promising of the others.
    std::stable_sort(starts_.begin(), starts_.end(), [](const Start& a, const Start& b) { return a.free > b.free; });
    for (const Start& start : starts_)
      if (start.free < probes && !is_done()) grow(start.q);
    return std::move(best_);
  }

 private:
  struct Start {
    Configuration q;
    int free;
  };

  bool is_known(const Configuration& q) const {
    return std::any_of(starts_.begin(), starts_.end(),
                       [&](const Start& other) { return (q - other.q).cwiseAbs().maxCoeff() < 0.3; });
  }

  void grow(const Configuration& start) {
    auto field = std::make_unique<PostureField>(scene_, view_, start, run_.helpers, run_.watch);
    if (!best_ || field->usable_cells() > best_->usable_cells()) best_ = std::move(field);
    ++grown_;
  }

  bool is_done() const {
    return grown_ == max_fields || (best_ && 100 * best_->usable_cells() >= 97 * PostureField::all_cells());
  }

  const Scene& scene_;
  const ToolView& view_;
  const RunContext& run_;
  std::vector<Start> starts_;
  std::unique_ptr<PostureField> best_;
  int grown_ = 0;
};

}  // namespace

std::unique_ptr<PostureField> find_field(const Scene& scene, const ToolView& view, const Configuration& home,
                                         const std::vector<Configuration>& known, const RunContext& run) {
  auto best = FieldSearch(scene, view, run).run(find_guesses(scene.chain(), home, known, run.seed));
  if (!best) best = std::make_unique<PostureField>(scene, view, home, run.helpers, run.watch);
  if (2 * best->usable_cells() > PostureField::all_cells()) best->refine(scene, run.helpers, run.watch);
  return best;
}

}  // namespace sculpt
