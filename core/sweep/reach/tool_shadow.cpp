#include "core/sweep/reach/tool_shadow.hpp"

#include <algorithm>

#include "core/material/voxel_rows.hpp"

namespace sculpt {

ToolShadow::ToolShadow(const VoxelSet& standing, Voxel lean) : standing_(standing), dark_(standing.n()), lean_(lean) {
  for (int part = 1; part < 8; ++part) {
    const Voxel w{(part & 1) * lean.i, (part >> 1 & 1) * lean.j, (part >> 2) * lean.k};
    if (w != Voxel{} && std::find(beside_.begin(), beside_.end(), w) == beside_.end()) beside_.push_back(w);
  }
  cast();
}

/// Row by row against the axis: dark is where something stands beside, or where it is dark one step along the axis.
void ToolShadow::cast() {
  const VoxelRows rows(standing_.n());
  const int n = standing_.n();
  const auto get = [&](const VoxelSet& set, int j, int k, int chunk) {
    const bool outside = j < 0 || j >= n || k < 0 || k >= n || chunk < 0 || chunk >= rows.chunks;
    return outside ? 0 : rows.get(set, j, k, chunk);
  };
  // What is at most one row away along the axis, without the row itself; that and what darkens the voxels beside.
  const auto straight = [&](int j, int k, int chunk) {
    std::uint64_t bits = 0;
    if (lean_.j != 0) bits |= get(standing_, j + lean_.j, k, chunk);
    if (lean_.k != 0) bits |= get(standing_, j, k + lean_.k, chunk);
    if (lean_.j != 0 && lean_.k != 0) bits |= get(standing_, j + lean_.j, k + lean_.k, chunk);
    return bits;
  };
  const auto across = [&](int j, int k, int chunk) {
    const std::uint64_t next = get(dark_, j + lean_.j, k + lean_.k, chunk);
    return lean_.i == 0 ? next : next | straight(j, k, chunk) | get(standing_, j, k, chunk);
  };
  for (int k = n - 1; k >= 0; --k)
    for (int row = n - 1; row >= 0; --row) {
      const int j = lean_.j < 0 ? n - 1 - row : row;
      for (int chunk = 0; chunk < rows.chunks; ++chunk) {
        std::uint64_t shifted = across(j, k, chunk);
        if (lean_.i > 0) shifted = shifted >> 1 | across(j, k, chunk + 1) << (rows.width - 1);
        if (lean_.i < 0) shifted = shifted << 1 | across(j, k, chunk - 1) >> (rows.width - 1);
        rows.put(dark_, j, k, chunk, (shifted | straight(j, k, chunk)) & rows.mask());
      }
    }
}

bool ToolShadow::is_lit(Voxel v) const {
  return is_clear(v + lean_) && std::none_of(beside_.begin(), beside_.end(),
                                             [&](Voxel w) { return inside(v + w) && standing_.contains(v + w); });
}

void ToolShadow::remove(Voxel v, const std::function<void(Voxel)>& lit) {
  standing_.erase(v);
  for (const Voxel w : beside_)
    for (Voxel u = v - w; inside(u) && dark_.contains(u) && is_lit(u); u = u - lean_) {
      dark_.erase(u);
      lit(u);
    }
}

void ToolShadow::put_back(Voxel v) {
  standing_.insert(v);
  for (const Voxel w : beside_)
    for (Voxel u = v - w; inside(u) && !dark_.contains(u); u = u - lean_) dark_.insert(u);
}

}  // namespace sculpt
