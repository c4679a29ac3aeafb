#include "core/mill/map/offset_map.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {
namespace {

/// Of a ring's radius at least: rings are looked at on cells as large as that lets them be.
constexpr double fine_cells = 14;

/// Down, by more than a float rounds.
float below(double height) {
  return std::nextafter(static_cast<float>(height), -std::numeric_limits<float>::infinity());
}

/// The least distance of two cells so many cells apart.
double min_distance(int da, int db, double step) {
  return step * std::hypot(std::max(0, std::abs(da) - 1), std::max(0, std::abs(db) - 1));
}

/// to[a] = max(to[a], from[a + da] - less), where both are.
void raise_row(float* to, const float* from, int width, int da, float less) {
  const int first = std::max(0, -da), last = std::min(width, width - da);
  for (int a = first; a < last; ++a) to[a] = std::max(to[a], from[a + da] - less);
}

/// Maxima over 2^k cells from each one on, for k from 0 up.
class WindowMaxima {
 public:
  WindowMaxima(const HeightMap& map, int widest) : width_(map.lattice.width) {
    levels_.push_back(map.heights);
    from_begin_ = map.heights;
    for (int b = 0; b < map.lattice.height; ++b)
      for (int a = 1; a < width_; ++a) {
        float& here = from_begin_[map.lattice.index(a, b)];
        here = std::max(here, from_begin_[map.lattice.index(a - 1, b)]);
      }
    for (int length = 1; 2 * length <= widest; length *= 2) {
      const std::vector<float>& half = levels_.back();
      std::vector<float> whole(half.size(), no_height);
      for (int b = 0; b < map.lattice.height; ++b) {
        const float* from = half.data() + static_cast<std::ptrdiff_t>(b) * width_;
        float* to = whole.data() + static_cast<std::ptrdiff_t>(b) * width_;
        for (int a = 0; a < width_; ++a) to[a] = a + length < width_ ? std::max(from[a], from[a + length]) : from[a];
      }
      levels_.push_back(std::move(whole));
    }
  }

  /// to[a] = max(to[a], the maximum of row b over a - half .. a + half, less `less`).
  void raise_row(float* to, int b, int half, float less) const {
    std::size_t level = 0;
    int length = 1;
    while (2 * length <= 2 * half + 1) length *= 2, ++level;
    const auto begin = static_cast<std::ptrdiff_t>(b) * width_;
    const float *row = levels_[level].data() + begin, *so_far = from_begin_.data() + begin;
    const int shift = half - length + 1, whole = std::min(half, width_);  // shift: of the second window's begin
    for (int a = 0; a < whole; ++a) to[a] = std::max(to[a], so_far[std::min(width_ - 1, a + half)] - less);
    for (int a = whole; a < width_; ++a)
      to[a] = std::max(to[a], std::max(row[a - half], row[std::min(width_ - 1, a + shift)]) - less);
  }

 private:
  int width_;
  std::vector<std::vector<float>> levels_;  ///< a window that goes beyond the row ends with it
  std::vector<float> from_begin_;           ///< of the row, up to each cell
};

}  // namespace

HeightMap offset_by_cutter(const HeightMap& stands, const Cutter& cutter, double more_m) {
  const Lattice& lattice = stands.lattice;
  HeightMap limit(lattice);
  const double step = lattice.step;
  const int reach = static_cast<int>(std::floor((cutter.radius_m + more_m) / step)) + 1;
  // Grown by `more`, a cutter is one with a larger radius and corner whose tip is that much lower.
  Cutter grown = cutter;
  grown.radius_m += more_m;
  grown.corner_radius_m += more_m;
  for (int db = -reach; db <= reach; ++db)
    for (int da = -reach; da <= reach; ++da) {
      const double r = min_distance(da, db, step);
      if (r > grown.radius_m) continue;
      const float less = below(grown.height_m(r) - more_m);
      for (int b = std::max(0, -db); b < std::min(lattice.height, lattice.height - db); ++b)
        raise_row(&limit.heights[lattice.index(0, b)], &stands.heights[lattice.index(0, b + db)], lattice.width, da,
                  less);
    }
  return limit;
}

namespace {

/// Of cells twice as large, as many times as rings are still `fine_cells` of them wide: no bound becomes lower.
HeightMap coarser(const HeightMap& map, int factor) {
  Lattice lattice = map.lattice;
  lattice.step *= factor;
  lattice.width = (lattice.width + factor - 1) / factor;
  lattice.height = (lattice.height + factor - 1) / factor;
  HeightMap coarse(lattice);
  for (int b = 0; b < map.lattice.height; ++b)
    for (int a = 0; a < map.lattice.width; ++a) coarse.raise(a / factor, b / factor, map.at(a, b));
  return coarse;
}

HeightMap offset_by_disc(const HeightMap& stands, const Ring& ring, double more_m) {
  const Lattice& lattice = stands.lattice;
  HeightMap limit(lattice);
  const double step = lattice.step;
  const int reach = static_cast<int>(std::floor((ring.radius_m + more_m) / step)) + 1;
  const WindowMaxima maxima(stands, 2 * reach + 1);
  const float less = below(ring.height_m - more_m);
  for (int db = -reach; db <= reach; ++db) {
    int half = reach;
    while (half >= 0 && min_distance(half, db, step) > ring.radius_m + more_m) --half;
    if (half < 0) continue;
    for (int b = std::max(0, -db); b < std::min(lattice.height, lattice.height - db); ++b)
      maxima.raise_row(&limit.heights[lattice.index(0, b)], b + db, half, less);
  }
  return limit;
}

}  // namespace

HeightMap offset_by_rings(const HeightMap& stands, const std::vector<Ring>& rings, double more_m) {
  const Lattice& lattice = stands.lattice;
  HeightMap limit(lattice);
  for (const Ring& ring : rings) {
    int factor = 1;
    while (ring.radius_m > 2 * factor * fine_cells * lattice.step) factor *= 2;
    const HeightMap disc = offset_by_disc(factor == 1 ? stands : coarser(stands, factor), ring, more_m);
    for (int b = 0; b < lattice.height; ++b)
      for (int a = 0; a < lattice.width; ++a) limit.raise(a, b, disc.at(a / factor, b / factor));
  }
  return limit;
}
HeightMap lowest_cut(const HeightMap& limit, const Cutter& cutter) {
  const Lattice& lattice = limit.lattice;
  HeightMap lowest(lattice);
  std::ranges::fill(lowest.heights, -no_height);
  const int reach = static_cast<int>(cutter.radius_m / lattice.step) + 1;
  for (int db = -reach; db <= reach; ++db)
    for (int da = -reach; da <= reach; ++da) {
      const double r = lattice.step * std::hypot(std::abs(da) + 0.5, std::abs(db) + 0.5);
      if (r > cutter.radius_m) continue;
      const auto more = static_cast<float>(cutter.height_m(r));
      for (int b = std::max(0, -db); b < std::min(lattice.height, lattice.height - db); ++b) {
        float* to = &lowest.heights[lattice.index(0, b)];
        const float* from = &limit.heights[lattice.index(0, b + db)];
        for (int a = std::max(0, -da); a < std::min(lattice.width, lattice.width - da); ++a)
          to[a] = std::min(to[a], from[a + da] + more);
      }
    }
  return lowest;
}

void raise_to(HeightMap& map, const HeightMap& other) {
  for (std::size_t at = 0; at < map.heights.size(); ++at)
    map.heights[at] = std::max(map.heights[at], other.heights[at]);
}

}  // namespace sculpt
