#include "core/mill/rough/cell_distances.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {
namespace {

/// Of (x - at)^2 + squares[at] over all `at` the least, for every x.
class LowerEnvelope {
 public:
  explicit LowerEnvelope(std::size_t size) : lowest_(size), from_(size + 1) {}

  void find(const std::vector<double>& squares, std::vector<double>& least) {
    std::size_t last = 0;
    lowest_[0] = 0;
    from_[0] = -HUGE_VAL;
    for (std::size_t at = 1; at < squares.size(); ++at) {
      double begin = crossing(squares, lowest_[last], at);
      while (begin <= from_[last]) begin = crossing(squares, lowest_[--last], at);
      lowest_[++last] = at;
      from_[last] = begin;
    }
    std::size_t here = 0;
    for (std::size_t x = 0; x < squares.size(); ++x) {
      while (here < last && from_[here + 1] < static_cast<double>(x)) ++here;
      const double off = static_cast<double>(x) - static_cast<double>(lowest_[here]);
      least[x] = off * off + squares[lowest_[here]];
    }
  }

 private:
  static double crossing(const std::vector<double>& squares, std::size_t before, std::size_t at) {
    const auto p = static_cast<double>(before), q = static_cast<double>(at);
    return (squares[at] + q * q - squares[before] - p * p) / (2 * (q - p));
  }

  std::vector<std::size_t> lowest_;
  std::vector<double> from_;
};

/// Of each cell of a row to the nearest marked one of that row, in cells; no farther than `far`.
void find_along(const char* marked, std::size_t width, double far, float* distances) {
  double since = far;
  for (std::size_t a = 0; a < width; ++a) {
    since = marked[a] ? 0 : std::min(far, since + 1);
    distances[a] = static_cast<float>(since);
  }
  since = far;
  for (std::size_t a = width; a-- > 0;) {
    since = marked[a] ? 0 : std::min(far, since + 1);
    distances[a] = std::min(distances[a], static_cast<float>(since));
  }
}

/// Of neighbouring columns together, for they lie beside each other.
constexpr std::size_t columns_at_once = 16;

}  // namespace

std::vector<float> distances_to(const std::vector<char>& marked, const Lattice& lattice, const Helpers* helpers) {
  const auto w = static_cast<std::size_t>(lattice.width), h = static_cast<std::size_t>(lattice.height);
  std::vector<float> distances(lattice.size());
  for (std::size_t b = 0; b < h; ++b)
    find_along(marked.data() + b * w, w, static_cast<double>(w + h), distances.data() + b * w);
  const auto find_across = [&](std::size_t first) {
    LowerEnvelope envelope(h);
    std::vector<double> squares(h), least(h);
    for (std::size_t a = first; a < std::min(w, first + columns_at_once); ++a) {
      for (std::size_t b = 0; b < h; ++b) squares[b] = std::pow(static_cast<double>(distances[b * w + a]), 2);
      envelope.find(squares, least);
      for (std::size_t b = 0; b < h; ++b) distances[b * w + a] = static_cast<float>(std::sqrt(least[b]) * lattice.step);
    }
  };
  const std::size_t parts = (w + columns_at_once - 1) / columns_at_once;
  if (helpers != nullptr)
    helpers->for_each_index(parts, [&](std::size_t part) { find_across(part * columns_at_once); });
  else
    for (std::size_t part = 0; part < parts; ++part) find_across(part * columns_at_once);
  return distances;
}

}  // namespace sculpt
