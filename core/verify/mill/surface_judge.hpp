// What the cutters of a plan do to the part's surface: found out beside the rest of a replay, as it needs nothing of
// it. Internal to verify/. Millimetres, stock frame.
#pragma once

#include <future>
#include <vector>

#include "core/cell/milling/mill_tool.hpp"
#include "core/verify/findings/findings.hpp"
#include "core/verify/mill/surface_grid.hpp"
#include "core/verify/mill/surface_points.hpp"

namespace sculpt {

/// A straight way of a cutter that cuts.
struct CutterWay {
  std::uint64_t line = 0;
  Cutter cutter;
  Vec3 axis, from, to;  ///< tips
  double stray = 0;
};

/// Not shared between threads, but has one of its own.
class SurfaceJudge {
 public:
  /// `part` in metres. `threads`: with one, all is done by the caller.
  SurfaceJudge(const Mesh& part, const VoxelGrid& voxels, const Grid& grid, int threads)
      : surface_(part), points_(draw_points(part, voxels, grid), grid), threads_(threads) {}

  /// Takes the next ways, and gives what was found of those before.
  PieceFindings take(std::vector<CutterWay> ways);
  /// What is left to find.
  PieceFindings finish() { return judging_.valid() ? judging_.get() : PieceFindings{}; }
  /// After `finish`. `standing`: voxels that may hold something.
  SurfaceVerdict verdict(const VoxelSet& standing) const { return points_.judge(standing); }

 private:
  PieceFindings judge(const std::vector<CutterWay>& ways);

  SurfaceGrid surface_;
  SurfacePoints points_;
  int threads_;
  std::future<PieceFindings> judging_;  ///< last: it uses the others
};

}  // namespace sculpt
