#include "core/timing/room/open_columns.hpp"

#include <algorithm>

namespace sculpt {
namespace {

int along(Voxel voxel, Voxel step) {
  return voxel.i * step.i + voxel.j * step.j + voxel.k * step.k;
}

bool is_in(Voxel voxel, int n) {
  return voxel.i >= 0 && voxel.j >= 0 && voxel.k >= 0 && voxel.i < n && voxel.j < n && voxel.k < n;
}

}  // namespace

int layer_of(Voxel voxel, std::size_t direction, int n) {
  const Voxel step = face_steps[direction];
  const int value = along(voxel, step);
  return step.i + step.j + step.k > 0 ? value : n - 1 + value;
}

OpenColumns::OpenColumns(int n)
    : n_(n),
      standing_((static_cast<std::size_t>(n) * static_cast<std::size_t>(n) * static_cast<std::size_t>(n) + 63) / 64,
                ~std::uint64_t{0}) {
  for (auto& columns : highest_)
    columns.assign(static_cast<std::size_t>(n) * static_cast<std::size_t>(n), static_cast<std::int16_t>(n - 1));
}

bool OpenColumns::stands(Voxel voxel) const {
  const std::size_t at = bit(voxel);
  return (standing_[at / 64] >> at % 64 & 1) != 0;
}

std::size_t OpenColumns::column(Voxel voxel, std::size_t direction) const {
  const Voxel step = face_steps[direction];
  const auto n = static_cast<std::size_t>(n_);
  const auto [first, second] = step.i != 0   ? std::pair{voxel.j, voxel.k}
                               : step.j != 0 ? std::pair{voxel.i, voxel.k}
                                             : std::pair{voxel.i, voxel.j};
  return static_cast<std::size_t>(first) + n * static_cast<std::size_t>(second);
}

void OpenColumns::remove(Voxel voxel) {
  if (!is_in(voxel, n_) || !stands(voxel)) return;
  standing_[bit(voxel) / 64] &= ~(std::uint64_t{1} << bit(voxel) % 64);
  const auto n = static_cast<std::size_t>(n_), i = static_cast<std::size_t>(voxel.i),
             j = static_cast<std::size_t>(voxel.j), k = static_cast<std::size_t>(voxel.k);
  const std::array<std::size_t, 3> columns{j + n * k, i + n * k, i + n * j};
  const std::array<int, 3> layers{voxel.i, voxel.j, voxel.k};
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t side = 0; side < 2; ++side) {
      const std::size_t direction = 2 * axis + side;
      std::int16_t& highest = highest_[direction][columns[axis]];
      if (highest == (side == 1 ? layers[axis] : n_ - 1 - layers[axis])) highest = next_below(voxel, direction);
    }
}

std::int16_t OpenColumns::next_below(Voxel voxel, std::size_t direction) const {
  while (is_in(voxel, n_) && !stands(voxel)) voxel = voxel - face_steps[direction];
  return static_cast<std::int16_t>(is_in(voxel, n_) ? layer_of(voxel, direction, n_) : -1);
}

bool OpenColumns::is_open(Voxel voxel, std::size_t direction, bool may_stand) const {
  const int layer = layer_of(voxel, direction, n_);
  Voxel inside = voxel;  // its column, if it has one
  const Voxel step = face_steps[direction];
  if (step.i != 0) inside.i = 0;
  if (step.j != 0) inside.j = 0;
  if (step.k != 0) inside.k = 0;
  if (!is_in(inside, n_)) return true;
  const int highest = highest_[direction][column(voxel, direction)];
  return highest < 0 || highest < layer + (may_stand ? 1 : 0);
}

bool OpenColumns::are_open(Voxel low, Voxel high, std::size_t direction, int most) const {
  const Voxel step = face_steps[direction], size = high - low;
  const int layer = std::min(layer_of(low, direction, n_), layer_of(high, direction, n_));
  if ((size.i + 1) * (size.j + 1) * (size.k + 1) / (std::abs(along(size, step)) + 1) > most) return false;
  const Voxel last = {step.i != 0 ? low.i : high.i, step.j != 0 ? low.j : high.j, step.k != 0 ? low.k : high.k};
  for (int k = low.k; k <= last.k; ++k)
    for (int j = low.j; j <= last.j; ++j)
      for (int i = low.i; i <= last.i; ++i) {
        Voxel inside{i, j, k};
        if (step.i != 0) inside.i = 0;
        if (step.j != 0) inside.j = 0;
        if (step.k != 0) inside.k = 0;
        if (!is_in(inside, n_)) continue;
        const int highest = highest_[direction][column(inside, direction)];
        if (highest >= 0 && highest >= layer) return false;
      }
  return true;
}

}  // namespace sculpt
