#include "core/mill/map/offset_map.hpp"

#include <algorithm>
#include <cmath>

#include "core/mill/map/cell_box.hpp"
#include "core/mill/map/float_bound.hpp"

namespace sculpt {
namespace {

/// Of a ring's radius at least: rings are looked at on cells as large as that lets them be.
constexpr double fine_cells = 14;

/// The least distance of two cells so many cells apart.
double min_distance(int da, int db, double step) {
  return step * std::hypot(std::max(0, std::abs(da) - 1), std::max(0, std::abs(db) - 1));
}

/// The cells in which something stands.
CellBox filled_of(const HeightMap& map) {
  const Lattice& lattice = map.lattice;
  CellBox filled{lattice.width, -1, lattice.height, -1};
  for (int b = 0; b < lattice.height; ++b) {
    const float* row = &map.heights[lattice.index(0, b)];
    const float* end = row + lattice.width;
    const auto stands = [](float height) { return height > no_height; };
    const float* first = std::find_if(row, end, stands);
    if (first == end) continue;
    while (!stands(*(end - 1))) --end;
    filled = {std::min(filled.first_a, static_cast<int>(first - row)),
              std::max(filled.last_a, static_cast<int>(end - row) - 1), std::min(filled.first_b, b), b};
  }
  return filled;
}

/// to[a] = max(to[a], from[a + da] - less), where something stands.
void raise_row(float* to, const float* from, int width, const CellBox& filled, int da, float less) {
  const int first = std::max(0, filled.first_a - da), last = std::min(width, filled.last_a + 1 - da);
  for (int a = first; a < last; ++a) to[a] = std::max(to[a], from[a + da] - less);
}

/// Maxima over 2^k cells around each one, for k from 0 up, where something stands.
class WindowMaxima {
 public:
  WindowMaxima(const HeightMap& map, int widest)
      : filled_(filled_of(map)), width_(filled_.last_a - filled_.first_a + 1) {
    const int rows = filled_.last_b - filled_.first_b + 1;
    if (width_ <= 0) return;
    // Rows with so much air on both sides that a window may go beyond them.
    room_ = widest;
    stride_ = static_cast<std::size_t>(width_) + 2 * static_cast<std::size_t>(room_);
    std::vector<float> all(stride_ * static_cast<std::size_t>(rows), no_height);
    for (int b = 0; b < rows; ++b)
      std::copy_n(&map.heights[map.lattice.index(filled_.first_a, b + filled_.first_b)], width_,
                  all.begin() + static_cast<std::ptrdiff_t>(stride_) * b + room_);
    levels_.push_back(std::move(all));
    for (std::size_t length = 1; 2 * length <= static_cast<std::size_t>(widest); length *= 2) {
      const std::vector<float>& half = levels_.back();
      std::vector<float> whole = half;
      for (std::size_t at = 0; at + length < half.size(); ++at) whole[at] = std::max(half[at], half[at + length]);
      levels_.push_back(std::move(whole));
    }
  }

  const CellBox& filled() const { return filled_; }

  /// to[a] = max(to[a], the maximum of row b over a - half .. a + half, less `less`), for a below `width`.
  void raise_row(float* to, int width, int b, int half, float less) const {
    std::size_t level = 0;
    int length = 1;
    while (2 * length <= 2 * half + 1) length *= 2, ++level;
    const int first = std::max(0, filled_.first_a - half), last = std::min(width - 1, filled_.last_a + half);
    const float* left = levels_[level].data() + static_cast<std::ptrdiff_t>(stride_) * (b - filled_.first_b) + room_ +
                        (first - half - filled_.first_a);
    const float* right = left + (2 * half + 1 - length);
    to += first;
    for (int at = 0; at <= last - first; ++at) to[at] = std::max(to[at], std::max(left[at], right[at]) - less);
  }

 private:
  CellBox filled_;
  int width_, room_ = 0;
  std::size_t stride_ = 0;
  std::vector<std::vector<float>> levels_;  ///< the window that begins at each cell
};

}  // namespace

Cutter grown_by(const Cutter& cutter, double more_m) {
  Cutter grown = cutter;
  grown.radius_m += more_m;
  grown.corner_radius_m += more_m;
  return grown;
}

HeightMap offset_by_cutter(const HeightMap& stands, const Cutter& cutter, double more_m) {
  const Lattice& lattice = stands.lattice;
  HeightMap limit(lattice);
  const double step = lattice.step;
  const int reach = static_cast<int>(std::floor((cutter.radius_m + more_m) / step)) + 1;
  const Cutter grown = grown_by(cutter, more_m);
  const CellBox filled = filled_of(stands);
  for (int db = -reach; db <= reach; ++db)
    for (int da = -reach; da <= reach; ++da) {
      const double r = min_distance(da, db, step);
      if (r > grown.radius_m) continue;
      const float less = below(grown.height_m(r) - more_m);
      for (int b = std::max(0, filled.first_b - db); b < std::min(lattice.height, filled.last_b + 1 - db); ++b)
        raise_row(&limit.heights[lattice.index(0, b)], &stands.heights[lattice.index(0, b + db)], lattice.width, filled,
                  da, less);
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

/// By one with cells so many times as large.
void raise_by_coarser(HeightMap& map, const HeightMap& coarse, int factor) {
  for (int b = 0; b < map.lattice.height; ++b) {
    const float* from = &coarse.heights[coarse.lattice.index(0, b / factor)];
    float* to = &map.heights[map.lattice.index(0, b)];
    for (int a = 0; a < map.lattice.width; a += factor, ++from)
      for (int fine = a; fine < std::min(a + factor, map.lattice.width); ++fine) to[fine] = std::max(to[fine], *from);
  }
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
    const CellBox& filled = maxima.filled();
    for (int b = std::max(0, filled.first_b - db); b < std::min(lattice.height, filled.last_b + 1 - db); ++b)
      maxima.raise_row(&limit.heights[lattice.index(0, b)], lattice.width, b + db, half, less);
  }
  return limit;
}

}  // namespace

HeightMap offset_by_rings(const HeightMap& stands, const std::vector<Ring>& rings, double more_m,
                          const Helpers* helpers) {
  const Lattice& lattice = stands.lattice;
  std::vector<std::pair<int, HeightMap>> discs(rings.size(), {1, HeightMap(Lattice{})});
  const auto offset = [&](std::size_t number) {
    auto& [factor, disc] = discs[number];
    while (rings[number].radius_m > 2 * factor * fine_cells * lattice.step) factor *= 2;
    disc = offset_by_disc(factor == 1 ? stands : coarser(stands, factor), rings[number], more_m);
  };
  if (helpers != nullptr)
    helpers->for_each_index(rings.size(), offset);
  else
    for (std::size_t number = 0; number < rings.size(); ++number) offset(number);
  HeightMap limit(lattice);
  for (const auto& [factor, disc] : discs) raise_by_coarser(limit, disc, factor);
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

}  // namespace sculpt
