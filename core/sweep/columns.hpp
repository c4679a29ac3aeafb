// What the ball does in one pass along one straight tool direction, cell by cell: no joints yet.
//
// Seen from the side, columns a = 0..7, the tool comes from above; # is to keep, o is to be removed, . is air:
//
//      c = 3   o o o . . o o o       layer 3: runs 0..2 and 5..7 of each row are free
//      c = 2   o # o o o o # o       layer 2: 0, 2..5, 7; over what is to be kept the ball lifts
//      c = 1   o o o # o o o o       layer 1: 0, 2, 4..5, 7; what is under it is not free, now or later
//      c = 0   o o o o o o o o       layer 0: 0, 2, 4..5, 7
//
// With the ball at a = 0 of layer 2, cell 0 just cut, the next run is 2..5, whose end a = 2 is the nearest. Cell 1 is
// in the way: the ball rises to a free layer, passes over it and comes down, cuts 2, then goes straight to 5: strokes
// (0, 4), (2, 4), (2, 3), cut 2..2, cut 3..5. If that last cut fails, its cells are put back and given up; `restore` is
// called for later strokes first, so that what stands is again what stood.
#pragma once

#include <cstdint>
#include <vector>

#include "core/sweep/reach/reach_rows.hpp"
#include "core/sweep/stroke.hpp"

namespace sculpt {

/// The material as the tool comes down on it: in each column only the topmost standing cell can be cut, as nothing may
/// stand above the ball. Not shared between threads.
class Columns {
 public:
  /// Cells first..last of row b of layer c.
  struct Run {
    int first, last, b, c;
    bool operator==(const Run&) const = default;
  };

  /// `reach` must outlive the object. `given_up`: what is not tried, of what stands.
  Columns(const ToolView& view, const VoxelSet& standing, const VoxelSet& keep, const ReachRows& reach,
          std::vector<Run> given_up = {});

  /// Cells that could be cut if every one that lies free now or later is.
  std::uint64_t count_cuttable() const;

  /// Cuts all that lies free in layer `c`, from `at` (updated), row by row there and back. `tolerance`: allowed beside
  /// material, in voxel edges.
  std::vector<Stroke> cut_layer(int c, Vec3& at, double tolerance);

  /// Straight up to above everything.
  std::vector<Stroke> rise(Vec3& at, double tolerance) const;

  /// Takes back a stroke of `cut_layer`, the last ones first. What it cut is not tried again if `give_up`.
  void restore(const Stroke& stroke, bool give_up);
  /// The run was given up, and no longer is.
  void try_again(const Run& run);

  /// What a stroke cuts.
  Run run_of(const Stroke& stroke) const;
  /// Together with what stands all that Columns remembers: others made from both go on as these would.
  const std::vector<Run>& given_up() const { return given_up_; }

 private:
  Voxel cell(Voxel voxel) const;
  void cover_down_to(int c);
  std::vector<std::vector<Run>> find_runs(int c) const;
  bool in_layer_free(int a0, int b0, int a1, int b1, int c) const;
  int free_layer_between(const Vec3& from, const Vec3& to, int c) const;
  void go_to(Voxel target, Vec3& at, double tolerance, std::vector<Stroke>& strokes);
  void cut(Voxel first, Voxel last, Vec3& at, double tolerance, std::vector<Stroke>& strokes);

  ToolView view_;
  const ReachRows& reach_;
  CellRows standing_, keep_;
  CellRows covered_;           ///< cells that stand or have something standing above them, from layer covered_from_ on
  int covered_from_;           ///< view_.n: in no layer of the grid yet
  std::vector<Run> given_up_;  ///< cells whose motion failed
};

}  // namespace sculpt
