#include "core/timing/room/open_columns.hpp"

#include <algorithm>

namespace sculpt {
namespace {

bool is_in(int at, int n) {
  return at >= 0 && at < n;
}
bool is_in(Voxel voxel, int n) {
  return is_in(voxel.i, n) && is_in(voxel.j, n) && is_in(voxel.k, n);
}

std::array<int, 3> coordinates(Voxel voxel) {
  return {voxel.i, voxel.j, voxel.k};
}

}  // namespace

/// What a direction goes along, and what across: by coordinates 0 to 2.
struct OpenColumns::Ray {
  explicit Ray(std::size_t direction)
      : along(direction / 2), first(along == 0 ? 1 : 0), second(along == 2 ? 1 : 2), up(direction % 2 == 1) {}

  std::size_t along, first, second;
  bool up;
};

OpenColumns::OpenColumns(int n)
    : n_(n),
      standing_((static_cast<std::size_t>(n) * static_cast<std::size_t>(n) * static_cast<std::size_t>(n) + 63) / 64,
                ~std::uint64_t{0}) {
  for (auto& columns : highest_)
    columns.assign(static_cast<std::size_t>(n) * static_cast<std::size_t>(n), static_cast<std::int16_t>(n - 1));
}

void OpenColumns::remove(Voxel voxel) {
  if (!is_in(voxel, n_)) return;
  const std::size_t at = bit(voxel);
  standing_[at / 64] &= ~(std::uint64_t{1} << at % 64);
}

bool OpenColumns::stands(std::size_t at) const {
  return (standing_[at / 64] >> at % 64 & 1) != 0;
}

/// Does anything stand in the column through these two coordinates, in that layer or beyond it?
bool OpenColumns::stands_from(int layer, const Ray& ray, int first, int second) {
  if (!is_in(first, n_) || !is_in(second, n_)) return false;
  const auto n = static_cast<std::size_t>(n_);
  std::int16_t& highest =
      highest_[2 * ray.along + ray.up][static_cast<std::size_t>(first) + n * static_cast<std::size_t>(second)];
  const std::array<std::size_t, 3> steps{1, n, n * n};
  const std::size_t foot =
      steps[ray.first] * static_cast<std::size_t>(first) + steps[ray.second] * static_cast<std::size_t>(second);
  for (layer = std::max(layer, 0); highest >= layer; --highest)
    if (stands(foot + steps[ray.along] * static_cast<std::size_t>(ray.up ? highest : n_ - 1 - highest))) return true;
  return false;
}

int OpenColumns::layer_of(int coordinate, const Ray& ray) const {
  return ray.up ? coordinate : n_ - 1 - coordinate;
}

bool OpenColumns::is_open(Voxel voxel, std::size_t direction, bool may_stand) {
  const Ray ray(direction);
  const auto at = coordinates(voxel);
  return !stands_from(layer_of(at[ray.along], ray) + (may_stand ? 1 : 0), ray, at[ray.first], at[ray.second]);
}

bool OpenColumns::are_open(Voxel low, Voxel high, std::size_t direction, int most) {
  const Ray ray(direction);
  const auto from = coordinates(low), to = coordinates(high);
  if ((to[ray.first] - from[ray.first] + 1) * (to[ray.second] - from[ray.second] + 1) > most) return false;
  const int layer = std::min(layer_of(from[ray.along], ray), layer_of(to[ray.along], ray));
  for (int second = from[ray.second]; second <= to[ray.second]; ++second)
    for (int first = from[ray.first]; first <= to[ray.first]; ++first)
      if (stands_from(layer, ray, first, second)) return false;
  return true;
}

}  // namespace sculpt
