// What the ball does in one pass along one tool direction, cell by cell: no joints yet.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "core/material/voxel_grid.hpp"
#include "core/sweep/tool_view.hpp"

namespace sculpt {

/// A straight line of the ball's centre from where the last stroke ended, in cells of the view. A cut goes along one
/// axis and removes the cells it comes to, `count` of them; all others pass through air only.
struct Stroke {
  Vec3 to = Vec3::Zero();
  int count = 0;          ///< 0: nothing is cut
  double stray = 0;       ///< how far the tool may leave the line (voxel edges) without coming near any material
  Voxel first{}, last{};  ///< cut: voxels of the grid
};

/// The material as the tool comes down on it: in each column only the topmost standing cell can be cut, as nothing may
/// stand above the ball. Not shared between threads.
class Columns {
 public:
  /// `reachable`: may the ball's centre be at this cell, for links and limits?
  Columns(const ToolView& view, const VoxelSet& standing, const VoxelSet& keep,
          std::function<bool(const Vec3& cell)> reachable);

  /// Cells that could be cut if every one that lies free now or later is.
  std::uint64_t count_cuttable() const;

  /// Cuts all that lies free in layer `c`, from `at` (updated), row by row there and back. `stray`: allowed beside
  /// material, in voxel edges.
  std::vector<Stroke> cut_layer(int c, Vec3& at, double stray);

  /// Straight up to above everything.
  std::vector<Stroke> rise(Vec3& at, double stray) const;

  /// Takes back a stroke of `cut_layer`, the last ones first. What it cut is not tried again if `give_up`.
  void restore(const Stroke& stroke, bool give_up);

 private:
  struct Run {
    int first, last;
  };

  int& height(int a, int b) { return heights_[static_cast<std::size_t>(b * view_.n + a)]; }
  int height(int a, int b) const { return heights_[static_cast<std::size_t>(b * view_.n + a)]; }
  /// Index of a cell's voxel in the sets.
  std::ptrdiff_t index(Voxel cell) const {
    return corner_ + cell.i * stride_[0] + cell.j * stride_[1] + cell.k * stride_[2];
  }
  static bool holds(const VoxelSet& set, std::ptrdiff_t at) {
    return set.words()[static_cast<std::size_t>(at) >> 6] >> (at & 63) & 1;
  }
  /// One above the topmost standing cell below `cell` in its column.
  int top_below(Voxel cell) const;
  bool can_cut(Voxel cell) const;
  std::vector<std::vector<Run>> find_runs(int c) const;
  void remove(Voxel cell);
  bool in_layer_free(int a0, int b0, int a1, int b1, int c) const;
  int highest_between(const Vec3& from, const Vec3& to) const;
  void go_to(Voxel target, Vec3& at, double stray, std::vector<Stroke>& strokes);
  void cut(Voxel first, Voxel last, Vec3& at, double stray, std::vector<Stroke>& strokes);

  ToolView view_;
  std::ptrdiff_t corner_;                 ///< index of cell (0, 0, 0)
  std::array<std::ptrdiff_t, 3> stride_;  ///< of the index, along a, b, c
  VoxelSet standing_, keep_;
  std::function<bool(const Vec3&)> reachable_;
  std::vector<int> heights_;  ///< per column: one above its topmost standing cell
  VoxelSet given_up_;         ///< voxels whose motion failed
};

}  // namespace sculpt
