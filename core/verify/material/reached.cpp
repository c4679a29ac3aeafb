#include "core/verify/material/reached.hpp"

#include <cstdint>
#include <utility>
#include <vector>

#include "core/material/voxel_rows.hpp"

namespace sculpt {
namespace {

/// All of the runs of `open` that hold one of `met`. Bits are added as numbers are: a bit that is added to the lowest
/// of a run of ones carries through to its end, and changes all that it passes.
std::uint64_t fill_up(std::uint64_t met, std::uint64_t open) {
  return met | (((open + met) ^ open) & open);
}

/// The lowest voxels of the runs of `open` that hold one of `met`, and those in between.
std::uint64_t fill_down(std::uint64_t met, std::uint64_t open) {
  for (int by = 1; by < 64; by *= 2) {
    met |= (met >> by) & open;
    open &= open >> by;
  }
  return met;
}

class Reached {
 public:
  Reached(const VoxelSet& open, VoxelSet seeds)
      : rows_(open.n()),
        open_(open),
        met_(std::move(seeds)),
        stale_(static_cast<std::size_t>(rows_.n) * rows_.n, true) {
    for (std::size_t at = 0; at < met_.words().size(); ++at) met_.words()[at] &= open.words()[at];
  }

  VoxelSet run() {
    for (bool grew = true; grew;) {
      grew = false;
      for (int k = 0; k < rows_.n; ++k)
        for (int j = 0; j < rows_.n; ++j) grew |= renew(j, k);
      for (int k = rows_.n - 1; k >= 0; --k)
        for (int j = rows_.n - 1; j >= 0; --j) grew |= renew(j, k);
    }
    return std::move(met_);
  }

 private:
  std::size_t row(int j, int k) const {
    return static_cast<std::size_t>(j) + static_cast<std::size_t>(rows_.n) * static_cast<std::size_t>(k);
  }

  /// From the rows around it, if any of them grew since that was last done. Says whether the row grew.
  bool renew(int j, int k) {
    if (!stale_[row(j, k)]) return false;
    stale_[row(j, k)] = false;
    const bool up = fill_row_up(j, k), down = fill_row_down(j, k);
    if (!up && !down) return false;
    for_each_beside(j, k, [this](int jb, int kb) { stale_[row(jb, kb)] = true; });
    return true;
  }

  /// From the rows beside it too.
  bool fill_row_up(int j, int k) {
    bool grew = false;
    std::uint64_t carry = 0;
    for (int chunk = 0; chunk < rows_.chunks; ++chunk) {
      const std::uint64_t open = rows_.get(open_, j, k, chunk);
      std::uint64_t met = rows_.get(met_, j, k, chunk) | carry;
      for_each_beside(j, k, [&](int jb, int kb) { met |= rows_.get(met_, jb, kb, chunk); });
      met = fill_up(met & open, open);
      grew |= put(j, k, chunk, met);
      carry = met >> (rows_.width - 1);
    }
    return grew;
  }

  bool fill_row_down(int j, int k) {
    bool grew = false;
    std::uint64_t carry = 0;
    for (int chunk = rows_.chunks - 1; chunk >= 0; --chunk) {
      const std::uint64_t open = rows_.get(open_, j, k, chunk);
      const std::uint64_t met = fill_down((rows_.get(met_, j, k, chunk) | (carry << (rows_.width - 1))) & open, open);
      grew |= put(j, k, chunk, met);
      carry = met & 1;
    }
    return grew;
  }

  template <typename Visit>
  void for_each_beside(int j, int k, const Visit& visit) const {
    if (j > 0) visit(j - 1, k);
    if (j + 1 < rows_.n) visit(j + 1, k);
    if (k > 0) visit(j, k - 1);
    if (k + 1 < rows_.n) visit(j, k + 1);
  }

  bool put(int j, int k, int chunk, std::uint64_t met) {
    if (met == rows_.get(met_, j, k, chunk)) return false;
    rows_.put(met_, j, k, chunk, met);
    return true;
  }

  VoxelRows rows_;
  const VoxelSet& open_;
  VoxelSet met_;
  std::vector<bool> stale_;  ///< rows that a row beside them grew since they were renewed
};

}  // namespace

VoxelSet reached_through(const VoxelSet& open, VoxelSet seeds) {
  return Reached(open, std::move(seeds)).run();
}

}  // namespace sculpt
