#include "core/search/open_space.hpp"

#include <algorithm>
#include <cassert>

namespace sculpt {
namespace {

int sign(int x) {
  return (x > 0) - (x < 0);
}

/// Goes along the axis only as far as `to` lies that way.
Voxel along(Voxel from, Voxel to, int axis) {
  if (axis == 0) return {to.i, from.j, from.k};
  if (axis == 1) return {from.i, to.j, from.k};
  return {from.i, from.j, to.k};
}

Voxel direction(Voxel from, Voxel to) {
  return {sign(to.i - from.i), sign(to.j - from.j), sign(to.k - from.k)};
}

}  // namespace

OpenSpace::OpenSpace(int n) : n_(n), cells_(static_cast<std::size_t>(n + 2) * (n + 2) * (n + 1)) {
  for (int k = 0; k <= n; ++k) {
    for (int j = -1; j <= n; ++j) {
      const bool row = k == n || j == -1 || j == n;
      for (int i = -1; i <= n; i += row ? 1 : n + 1) open({i, j, k});
    }
  }
}

void OpenSpace::open_cube(Voxel corner, int size) {
  for (int k = 0; k < size; ++k)
    for (int j = 0; j < size; ++j)
      for (int i = 0; i < size; ++i) open(corner + Voxel{i, j, k});
}

void OpenSpace::want_cube(Voxel corner, int size) {
  for (int k = 0; k < size; ++k)
    for (int j = 0; j < size; ++j)
      for (int i = 0; i < size; ++i) cells_[index(corner + Voxel{i, j, k})] |= wanted_bit;
}

bool OpenSpace::leg_is_open(Voxel from, Voxel to) const {
  const Voxel step = direction(from, to);
  for (Voxel at = from; at != to; at = at + step)
    if (!is_open(at + step)) return false;
  return true;
}

bool OpenSpace::try_legs(Voxel from, Voxel to, std::vector<Voxel>& way) const {
  // Up first and down last, sideways between: that is free most often.
  constexpr int orders[6][3] = {{2, 0, 1}, {2, 1, 0}, {0, 1, 2}, {1, 0, 2}, {0, 2, 1}, {1, 2, 0}};
  for (const auto& order : orders) {
    way.clear();
    Voxel at = from;
    bool free = true;
    for (int leg = 0; leg < 3 && free; ++leg) {
      const Voxel next = along(at, to, order[leg]);
      free = leg_is_open(at, next);
      if (next != at) way.push_back(next);
      at = next;
    }
    if (free) return true;
  }
  return false;
}

void OpenSpace::push(Entry entry, std::size_t detour) {
  if (frontier_.size() <= detour) frontier_.resize(detour + 1);
  frontier_[detour].push_back(entry);
}

/// False if the voxel was closed before.
bool OpenSpace::close(Entry entry) {
  std::uint8_t& cell = cells_[index(entry.at)];
  if (cell & closed_bit) return false;
  cell |= static_cast<std::uint8_t>(closed_bit | entry.face << parent_shift);
  if (touched_.size() < most_touched) touched_.push_back(index(entry.at));
  return true;
}

bool OpenSpace::search(Voxel from, Voxel to, std::size_t limit) {
  push({from, 0}, 0);
  for (std::size_t detour = 0; detour < frontier_.size(); ++detour) {
    while (!frontier_[detour].empty()) {
      const Entry entry = frontier_[detour].back();
      frontier_[detour].pop_back();
      if (!close(entry)) continue;
      if (entry.at == to) return true;
      if (touched_.size() >= limit) return false;
      for (std::uint8_t face = 0; face < 6; ++face) {
        const Voxel next = entry.at + face_steps[face];
        if (!is_open(next) || (cells_[index(next)] & closed_bit)) continue;
        push({next, face}, detour + (l1(next, to) > l1(entry.at, to) ? 1 : 0));
      }
    }
  }
  return false;
}

void OpenSpace::forget_search() {
  if (touched_.size() < most_touched) {
    for (std::size_t at : touched_) cells_[at] &= open_bit | wanted_bit;
  } else {
    for (std::uint8_t& cell : cells_) cell &= open_bit | wanted_bit;
  }
  touched_.clear();
  for (auto& bucket : frontier_) bucket.clear();
}

std::vector<Voxel> OpenSpace::trace(Voxel from, Voxel to) const {
  std::vector<Voxel> way;
  int last_face = -1;
  for (Voxel at = to; at != from;) {
    const int face = cells_[index(at)] >> parent_shift;
    if (face != last_face) way.push_back(at);
    last_face = face;
    at = at - face_steps[face];
  }
  std::reverse(way.begin(), way.end());
  return way;
}

std::optional<std::vector<Voxel>> OpenSpace::find_way(Voxel from, Voxel to, std::size_t limit) {
  std::vector<Voxel> way;
  if (try_legs(from, to, way)) return way;
  const bool found = search(from, to, limit);
  if (found) way = trace(from, to);
  forget_search();
  if (!found) return std::nullopt;
  return way;
}

OpenSpace::Wanted OpenSpace::find_wanted(Voxel from) {
  // Layer by layer, so that only two layers are held.
  std::vector<Entry> layer{{from, 0}}, next_layer;
  close(layer[0]);
  while (!layer.empty()) {
    for (const Entry& entry : layer) {
      for (std::uint8_t face = 0; face < 6; ++face) {
        const Voxel beside = entry.at + face_steps[face];
        if (!inside(beside)) continue;
        const std::uint8_t cell = cells_[index(beside)];
        if (cell == wanted_bit) {
          Wanted found{beside, trace(from, entry.at)};
          forget_search();
          return found;
        }
        if ((cell & open_bit) && close({beside, face})) next_layer.push_back({beside, face});
      }
    }
    layer.swap(next_layer);
    next_layer.clear();
  }
  assert(false && "find_wanted needs a wanted voxel beside connected air");
  return {};
}

}  // namespace sculpt
