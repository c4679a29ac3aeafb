// What the ball does in one pass along one tool direction, cell by cell: no joints yet.
#pragma once

#include <cstdint>
#include <vector>

#include "core/sweep/reach_rows.hpp"
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
  /// What was given up is tried again.
  void try_again(const Run& run);

  /// What a stroke cuts.
  Run run_of(const Stroke& stroke) const;
  /// With it and what stands, others are as these are.
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
