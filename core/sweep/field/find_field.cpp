#include "core/sweep/field/find_field.hpp"

#include <algorithm>
#include <bitset>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "core/base/helpers.hpp"
#include "core/cell/ik.hpp"
#include "core/motion/random_configuration.hpp"

namespace sculpt {
namespace {

constexpr int random_guesses = 24;
constexpr int max_tries = 4;
constexpr std::size_t enough_percent = 97, worth_percent = 1;  // of all parts of the lattice
constexpr double probe_half = 0.03;                            // rad or m: what the joints do within a cell of a field
constexpr int quarter = PostureLattice::cells / 4;

/// Some ball positions all over the grid.
using Probes = std::bitset<27>;
/// Parts of a lattice.
using Parts = std::vector<bool>;

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

/// Where the arm has room, if it comes there from `start`.
Probes find_free_probes(const Scene& scene, const ToolView& view, const Configuration& start) {
  const double last = view.n - 1;
  Probes free;
  std::size_t probe = 0;
  for (double a : {0.5, 0.0, 1.0})
    for (double b : {0.5, 0.0, 1.0}) {
      std::optional<Configuration> q = start;
      for (double c : {1.0, 0.5, 0.0}) {
        if (q) q = solve_ik(scene.chain(), {view.ball_m(scene.grid(), Vec3(a, b, c) * last), view.axis()}, *q);
        if (q) {
          const Configuration half = Configuration::Constant(q->size(), probe_half);
          Scene::Pairs pairs = scene.pairs();
          free[probe] = !scene.bubble(*q, {*q - half, *q + half}, {}, scene.full_stock(), pairs).empty();
        }
        ++probe;
      }
    }
  return free;
}

/// Grows fields from one start after the other and keeps those that cover what none before does.
class FieldSearch {
 public:
  FieldSearch(const Scene& scene, const ToolView& view, const RunContext& run)
      : scene_(scene), view_(view), run_(run), covered_(PostureField::all_cells()) {}

  std::vector<std::unique_ptr<PostureField>> run(const std::vector<Configuration>& guesses) {
    const int middle = PostureLattice::cells / 2;
    look_from(middle, middle, guesses);
    grow_promising();
    for (const auto& [i, j] : {std::pair{0, 1}, {1, 0}, {0, -1}, {-1, 0}}) {
      if (is_done()) break;
      look_from(middle + i * quarter, middle + j * quarter, guesses);
      grow_promising();
    }
    for (const auto& field : fields_)
      if (2 * field->usable_cells() > PostureField::all_cells())
        field->refine(scene_, scene_.full_stock(), run_.helpers, run_.watch);
    return std::move(fields_);
  }

 private:
  struct Start {
    PostureLattice::Start from;
    Probes free;
  };

  /// Starts with the ball above a node of the top; grows from those with room everywhere at once. The first guess is
  /// often the one: the others are looked at side by side, more and more of them.
  void look_from(int i, int j, const std::vector<Configuration>& guesses) {
    std::vector<Configuration> here;
    for (std::size_t first = 0, count = 1; first < guesses.size() && !is_done(); first += count, count *= 2) {
      const auto some = std::span(guesses).subspan(first).first(std::min(count, guesses.size() - first));
      for (Start& start : find_starts(i, j, some, here)) {
        if (is_done()) return;
        starts_.push_back(std::move(start));
        if (starts_.back().free.all()) grow(starts_.back());
      }
    }
  }

  /// From the guesses, those that touch nothing and are not nearly one of those found `here` before.
  std::vector<Start> find_starts(int i, int j, std::span<const Configuration> guesses,
                                 std::vector<Configuration>& here) const {
    const Vec3 above = ToolView::place(PostureLattice::hub_of(view_.n, {{}, i, j})) - Vec3(0.5, 0.5, 0);
    const IkGoal goal{view_.ball_m(scene_.grid(), above), view_.axis()};
    std::vector<std::optional<Configuration>> reached(guesses.size());
    run_.helpers.for_each_index(guesses.size(), [&](std::size_t guess) {
      if (run_.watch.stop.stop_requested()) throw Cancelled{};
      reached[guess] = solve_ik(scene_.chain(), goal, guesses[guess]);
    });
    const std::size_t known = here.size();
    for (const auto& q : reached) {
      const auto is_it = [&](const Configuration& other) { return (*q - other).cwiseAbs().maxCoeff() < 0.3; };
      if (q && std::ranges::none_of(here, is_it)) here.push_back(*q);
    }
    std::vector<std::optional<Start>> found(here.size() - known);
    run_.helpers.for_each_index(found.size(), [&](std::size_t at) {
      const Configuration& q = here[known + at];
      if (scene_.contact_at(q) == Contact::none) found[at] = {{q, i, j}, find_free_probes(scene_, view_, q)};
    });
    std::vector<Start> starts;
    for (auto& start : found)
      if (start) starts.push_back(std::move(*start));
    return starts;
  }

  /// From the starts that have room where none before had, the most promising first.
  void grow_promising() {
    while (!is_done()) {
      const auto gain = [&](const Start& start) { return (start.free & ~probed_).count(); };
      const auto best = std::ranges::max_element(starts_, {}, gain);
      if (best == starts_.end() || gain(*best) == 0) return;
      grow(*best);
    }
  }

  /// Keeps the field if it adds to those before, and it alone if it covers enough alone.
  void grow(const Start& start) {
    ++tried_;
    probed_ |= start.free;
    auto field = std::make_unique<PostureField>(scene_, view_, start.from, run_.helpers, run_.watch);
    if (100 * field->usable_cells() >= enough_percent * PostureField::all_cells()) fields_.clear();
    Parts all = covered_;
    for (std::size_t part = 0; part < all.size(); ++part)
      if (field->usable_part(PostureLattice::part_of(part))) all[part] = true;
    const std::size_t added = count(all) - count(covered_);
    if (!fields_.empty() && 100 * added < worth_percent * PostureField::all_cells()) return;
    covered_ = std::move(all);
    fields_.push_back(std::move(field));
  }

  static std::size_t count(const Parts& parts) { return static_cast<std::size_t>(std::ranges::count(parts, true)); }

  bool is_done() const {
    return tried_ == max_tries || 100 * count(covered_) >= enough_percent * PostureField::all_cells();
  }

  const Scene& scene_;
  const ToolView& view_;
  const RunContext& run_;
  std::vector<Start> starts_;
  std::vector<std::unique_ptr<PostureField>> fields_;
  Parts covered_;  ///< by the fields
  Probes probed_;  ///< where starts had room that fields were grown from
  int tried_ = 0;
};

}  // namespace

std::vector<std::unique_ptr<PostureField>> find_fields(const Scene& scene, const ToolView& view,
                                                       const Configuration& home,
                                                       const std::vector<Configuration>& known, const RunContext& run) {
  auto fields = FieldSearch(scene, view, run).run(find_guesses(scene.chain(), home, known, run.seed));
  if (fields.empty())
    fields.push_back(std::make_unique<PostureField>(scene, view, PostureLattice::Start{home}, run.helpers, run.watch));
  return fields;
}

}  // namespace sculpt
