#include "core/collision/material.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {
namespace {

/// Below this the few voxels along the capsule are looked at one by one, above it cubes of them are.
constexpr double thin_radius = 1;

/// The part of the segment with low <= coordinate[axis] <= high, as parameters; false if there is none.
bool clip(const Segment& segment, int axis, double low, double high, double& from, double& to) {
  const double start = segment.a[axis], step = segment.b[axis] - start;
  if (step == 0) return start >= low && start <= high;
  double enter = (low - start) / step, leave = (high - start) / step;
  if (enter > leave) std::swap(enter, leave);
  from = std::max(from, enter);
  to = std::min(to, leave);
  return from <= to;
}

int floor_to(double x, int low, int high) {
  return static_cast<int>(std::floor(std::clamp(x, static_cast<double>(low), static_cast<double>(high))));
}

}  // namespace

Material::Material(const VoxelSet& standing) : solid_(standing) {
  for (int level = lowest_kept; level <= level_of(n()); ++level) {
    const int m = n() >> level;
    std::vector<std::uint32_t, LargePages<std::uint32_t>> sums;
    sums.reserve(static_cast<std::size_t>(m) * m * m);
    for (int k = 0; k < m; ++k)
      for (int j = 0; j < m; ++j)
        for (int i = 0; i < m; ++i) {
          std::uint32_t sum = 0;
          for (int child = 0; child < 8; ++child)
            sum += count(level - 1, {2 * i + (child & 1), 2 * j + (child >> 1 & 1), 2 * k + (child >> 2)});
          sums.push_back(sum);
        }
    counts_.push_back(std::move(sums));
  }
}

void Material::remove(Voxel v) {
  if (!solid_.contains(v)) return;
  solid_.erase(v);
  for (int level = lowest_kept; level <= level_of(n()); ++level) {
    const std::size_t m = static_cast<std::size_t>(n()) >> level;
    const auto at = [level](int x) { return static_cast<std::size_t>(x) >> level; };
    --counts_[static_cast<std::size_t>(level - lowest_kept)][at(v.i) + m * (at(v.j) + m * at(v.k))];
  }
}

bool Material::meets_capsule(const Segment& segment, double radius, const Exempt& exempt) const {
  if (radius < thin_radius) return meets_thin_capsule(segment, radius, exempt);
  return cube_meets_capsule(level_of(n()), {0, 0, 0}, segment, radius, exempt);
}

bool Material::cube_meets_capsule(int level, Voxel at, const Segment& segment, double radius,
                                  const Exempt& exempt) const {
  const std::uint32_t standing = count(level, at);
  if (standing == 0) return false;
  const int size = 1 << level;
  const Voxel corner = at * size;
  const Vec3 low(corner.i, corner.j, corner.k);
  if (distance_to_box(segment, low, low + Vec3::Constant(size)) >= radius) return false;
  const bool holds_exempt = exempt.meets(corner, size);
  if (level == 0) return !holds_exempt;
  if (standing == volume(level) && !holds_exempt) return true;
  for (int child = 0; child < 8; ++child) {
    const Voxel below{2 * at.i + (child & 1), 2 * at.j + (child >> 1 & 1), 2 * at.k + (child >> 2)};
    if (cube_meets_capsule(level - 1, below, segment, radius, exempt)) return true;
  }
  return false;
}

bool Material::meets_thin_capsule(const Segment& segment, double radius, const Exempt& exempt) const {
  const Vec3 d = segment.b - segment.a;
  int main = 0;
  d.cwiseAbs().maxCoeff(&main);
  const int last = n() - 1;
  const double lowest = std::min(segment.a[main], segment.b[main]) - radius;
  const double highest = std::max(segment.a[main], segment.b[main]) + radius;
  if (highest <= 0 || lowest >= n()) return false;
  const int first_slab = floor_to(lowest, 0, last), last_slab = floor_to(highest, 0, last);
  // From a on: what is in the way of a tool is most often beside its ball.
  for (int ahead = 0; ahead <= last_slab - first_slab; ++ahead) {
    const int slab = d[main] < 0 ? last_slab - ahead : first_slab + ahead;
    if (slab_meets_capsule(main, slab, segment, radius, exempt)) return true;
  }
  return false;
}

bool Material::slab_meets_capsule(int main, int slab, const Segment& segment, double radius,
                                  const Exempt& exempt) const {
  double from = 0, to = 1;
  if (!clip(segment, main, slab - radius, slab + 1 + radius, from, to)) return false;
  const Vec3 d = segment.b - segment.a;
  const Vec3 p = segment.a + from * d, q = segment.a + to * d;
  const int u = (main + 1) % 3, v = (main + 2) % 3, last = n() - 1;
  const double low_u = std::min(p[u], q[u]) - radius, high_u = std::max(p[u], q[u]) + radius;
  const double low_v = std::min(p[v], q[v]) - radius, high_v = std::max(p[v], q[v]) + radius;
  if (high_u <= 0 || low_u >= n() || high_v <= 0 || low_v >= n()) return false;
  for (int y = floor_to(low_v, 0, last); y <= floor_to(high_v, 0, last); ++y) {
    for (int x = floor_to(low_u, 0, last); x <= floor_to(high_u, 0, last); ++x) {
      int cell[3];
      cell[main] = slab;
      cell[u] = x;
      cell[v] = y;
      const Voxel at{cell[0], cell[1], cell[2]};
      if (!solid_.contains(at) || exempt.contains(at)) continue;
      const Vec3 low(at.i, at.j, at.k);
      if (distance_to_box(segment, low, low + Vec3::Ones()) < radius) return true;
    }
  }
  return false;
}

}  // namespace sculpt
