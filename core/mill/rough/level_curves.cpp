#include "core/mill/rough/level_curves.hpp"

#include <array>
#include <cstdint>

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

class Tracer {
 public:
  Tracer(const std::vector<float>& field, const Lattice& lattice, double value)
      : field_(field),
        lattice_(lattice),
        value_(value),
        next_(2 * lattice.size(), -1),
        is_entered_(2 * lattice.size()) {
    for (int b = 0; b + 1 < lattice.height; ++b)
      for (int a = 0; a + 1 < lattice.width; ++a) {
        const unsigned larger =
            is_larger(a, b) | is_larger(a + 1, b) << 1 | is_larger(a + 1, b + 1) << 2 | is_larger(a, b + 1) << 3;
        for (const LevelSegment& segment : segments[larger]) {
          if (segment.from < 0) continue;
          next_[side(a, b, segment.from)] = static_cast<std::int32_t>(side(a, b, segment.to));
          is_entered_[side(a, b, segment.to)] = 1;
        }
      }
  }

  std::vector<Curve> run() {
    for (std::size_t at = 0; at < next_.size(); ++at)
      if (next_[at] >= 0 && !is_entered_[at]) trace(at);
    for (std::size_t at = 0; at < next_.size(); ++at)
      if (next_[at] >= 0) trace(at);
    return std::move(curves_);
  }

 private:
  unsigned is_larger(int a, int b) const { return static_cast<double>(field_[lattice_.index(a, b)]) > value_ ? 1 : 0; }

  /// Two of each cell: from its middle to the right, and upwards.
  std::size_t side(int a, int b, int number) const {
    if (number == 0) return 2 * lattice_.index(a, b);
    if (number == 1) return 2 * lattice_.index(a + 1, b) + 1;
    if (number == 2) return 2 * lattice_.index(a, b + 1);
    return 2 * lattice_.index(a, b) + 1;
  }

  Point2 point(std::size_t number) const {
    const std::size_t at = number / 2;
    const bool up = number % 2 == 1;
    const int a = static_cast<int>(at) % lattice_.width, b = static_cast<int>(at) / lattice_.width;
    const auto here = static_cast<double>(field_[at]),
               there = static_cast<double>(field_[lattice_.index(up ? a : a + 1, up ? b + 1 : b)]);
    const double share = (value_ - here) / (there - here) * lattice_.step;
    return {lattice_.u(a) + (up ? 0 : share), lattice_.v(b) + (up ? share : 0)};
  }

  void trace(std::size_t from) {
    Curve curve{point(from)};
    for (std::size_t at = from; next_[at] >= 0;) {
      const auto to = static_cast<std::size_t>(next_[at]);
      next_[at] = -1;
      curve.push_back(point(to));
      at = to;
    }
    curves_.push_back(std::move(curve));
  }

  const std::vector<float>& field_;
  const Lattice& lattice_;
  double value_;
  std::vector<std::int32_t> next_;
  std::vector<char> is_entered_;
  std::vector<Curve> curves_;
};

}  // namespace

std::vector<Curve> level_curves(const std::vector<float>& field, const Lattice& lattice, double value) {
  return Tracer(field, lattice, value).run();
}

}  // namespace sculpt
