#include "core/sweep/find_field.hpp"

#include <algorithm>
#include <numbers>
#include <optional>

#include "core/cell/ik.hpp"
#include "core/motion/random_configuration.hpp"

namespace sculpt {
namespace {

constexpr int random_guesses = 24;
constexpr std::size_t most_fields = 3;
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
        free += !scene.bubble(*q, {*q - half, *q + half}, pairs).empty();
      }
    }
  return free;
}

struct Start {
  Configuration q;
  int free;
};

/// Different configurations above the middle of the grid, the most promising first; no more of them once one has room
/// everywhere.
std::vector<Start> find_starts(const Scene& scene, const ToolView& view, const std::vector<Configuration>& guesses) {
  const double middle = (view.n - 1) / 2.0;
  const IkGoal above{view.ball_m(scene.grid(), {middle, middle, view.n + 1.0}), view.axis()};
  std::vector<Start> starts;
  for (const Configuration& guess : guesses) {
    const auto q = solve_ik(scene.chain(), above, guess);
    if (!q || scene.contact_at(*q) != Contact::none) continue;
    const bool known = std::any_of(starts.begin(), starts.end(),
                                   [&](const Start& other) { return (*q - other.q).cwiseAbs().maxCoeff() < 0.3; });
    if (known) continue;
    starts.push_back({*q, count_free_probes(scene, view, *q)});
    if (starts.back().free == probes) break;
  }
  std::stable_sort(starts.begin(), starts.end(), [](const Start& a, const Start& b) { return a.free > b.free; });
  return starts;
}

}  // namespace

std::unique_ptr<PostureField> find_field(const Scene& scene, const ToolView& view, const Configuration& home,
                                         const std::vector<Configuration>& known, std::uint64_t seed, int threads,
                                         const Watch& watch) {
  const std::vector<Start> starts = find_starts(scene, view, find_guesses(scene.chain(), home, known, seed));
  std::unique_ptr<PostureField> best;
  for (std::size_t start = 0; start < std::min(starts.size(), most_fields); ++start) {
    auto field = std::make_unique<PostureField>(scene, view, starts[start].q, threads, watch);
    if (!best || field->usable_cells() > best->usable_cells()) best = std::move(field);
    if (20 * best->usable_cells() >= 17 * PostureField::all_cells()) break;
  }
  if (!best) best = std::make_unique<PostureField>(scene, view, home, threads, watch);
  if (2 * best->usable_cells() > PostureField::all_cells()) best->refine(scene, threads, watch);
  return best;
}

}  // namespace sculpt
