#include "core/mill/map/level_curves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace sculpt {
namespace {

/// Sides of a square between four middles: below, right, above, left; its corners from the lower left one around.
struct LevelSegment {
  int from = -1, to = -1;
};
/// By which corners are larger, a bit each; of the two ways in which opposite corners can be joined, apart.
constexpr std::array<std::array<LevelSegment, 2>, 16> segments{{{{}},
                                                                {{{0, 3}}},
                                                                {{{1, 0}}},
                                                                {{{1, 3}}},
                                                                {{{2, 1}}},
                                                                {{{0, 3}, {2, 1}}},
                                                                {{{2, 0}}},
                                                                {{{2, 3}}},
                                                                {{{3, 2}}},
                                                                {{{0, 2}}},
                                                                {{{1, 0}, {3, 2}}},
                                                                {{{1, 2}}},
                                                                {{{3, 1}}},
                                                                {{{0, 1}}},
                                                                {{{3, 0}}},
                                                                {{}}}};

/// The largest float that is not above it.
float float_below(double value) {
  const auto near = static_cast<float>(value);
  return static_cast<double>(near) > value ? std::nextafter(near, -std::numeric_limits<float>::infinity()) : near;
}

class Tracer {
 public:
  Tracer(const std::vector<float>& field, const Lattice& lattice, double value)
      : field_(field), lattice_(lattice), value_(value) {
    const auto width = static_cast<std::size_t>(lattice.width);
    const float limit = float_below(value);
    std::vector<std::uint8_t> lower(width), upper(width);
    for (int b = 0; b < lattice.height; ++b) {
      const float* row = field.data() + lattice.index(0, b);
      for (std::size_t a = 0; a < width; ++a) upper[a] = row[a] > limit;
      if (b > 0) add_row(lower, upper, b - 1);
      lower.swap(upper);
    }
    std::ranges::sort(steps_, {}, &Step::from);
    for (const Step& step : steps_)
      if (const std::size_t next = find(step.to); next < steps_.size()) steps_[next].is_entered = true;
  }

  std::vector<Curve> run() {
    for (std::size_t at = 0; at < steps_.size(); ++at)
      if (!steps_[at].is_entered) trace(at);
    for (std::size_t at = 0; at < steps_.size(); ++at)
      if (!steps_[at].is_done) trace(at);
    return std::move(curves_);
  }

 private:
  /// From side to side of a square.
  struct Step {
    std::uint32_t from, to;
    bool is_entered = false, is_done = false;
  };

  /// Squares between two rows of middles; of each middle whether it is larger.
  void add_row(const std::vector<std::uint8_t>& lower, const std::vector<std::uint8_t>& upper, int b) {
    for (std::size_t a = 0; a + 1 < lower.size(); ++a) {
      const unsigned larger = lower[a] | lower[a + 1] << 1U | upper[a + 1] << 2U | upper[a] << 3U;
      if (larger == 0 || larger == 15) continue;
      for (const LevelSegment& segment : segments[larger])
        if (segment.from >= 0)
          steps_.push_back({side(static_cast<int>(a), b, segment.from), side(static_cast<int>(a), b, segment.to)});
    }
  }

  /// The step that begins at a side; their number where none does.
  std::size_t find(std::uint32_t from) const {
    const auto step = std::ranges::lower_bound(steps_, from, {}, &Step::from);
    return step != steps_.end() && step->from == from ? static_cast<std::size_t>(step - steps_.begin()) : steps_.size();
  }

  /// Two of each cell: from its middle to the right, and upwards.
  std::uint32_t side(int a, int b, int number) const {
    if (number == 1) ++a;
    if (number == 2) ++b;
    return static_cast<std::uint32_t>(2 * lattice_.index(a, b)) + static_cast<std::uint32_t>(number % 2);
  }

  Point2 point(std::uint32_t number) const {
    const std::size_t at = number / 2;
    const bool up = number % 2 == 1;
    const int a = static_cast<int>(at) % lattice_.width, b = static_cast<int>(at) / lattice_.width;
    const auto here = static_cast<double>(field_[at]),
               there = static_cast<double>(field_[lattice_.index(up ? a : a + 1, up ? b + 1 : b)]);
    const double share = (value_ - here) / (there - here) * lattice_.step;
    return {lattice_.u(a) + (up ? 0 : share), lattice_.v(b) + (up ? share : 0)};
  }

  void trace(std::size_t at) {
    Curve curve{point(steps_[at].from)};
    for (; at < steps_.size() && !steps_[at].is_done; at = find(steps_[at].to)) {
      steps_[at].is_done = true;
      curve.push_back(point(steps_[at].to));
    }
    curves_.push_back(std::move(curve));
  }

  const std::vector<float>& field_;
  const Lattice& lattice_;
  double value_;
  std::vector<Step> steps_;  ///< by where they begin
  std::vector<Curve> curves_;
};

}  // namespace

std::vector<Curve> level_curves(const std::vector<float>& field, const Lattice& lattice, double value) {
  return Tracer(field, lattice, value).run();
}

}  // namespace sculpt
