// What a ball cutter is led along in one direction: rings or rows, rows by walls, and lines through what these leave;
// one after the other, as far as it is worth the way.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/run_context.hpp"
#include "core/mill/finish/cut_preview.hpp"
#include "core/mill/finish/envelope.hpp"
#include "core/mill/finish/nail_reach.hpp"
#include "core/mill/finish/rows/resting_ball.hpp"
#include "core/mill/finish/rows/wall_rows.hpp"
#include "core/mill/finish/tour/worthwhile_tour.hpp"
#include "core/mill/map/level_curves.hpp"

namespace sculpt {

struct DirectionTask {
  std::size_t direction = 0;
  const Site& site;
  const EnvelopeTask& envelope;
  double spacing_m = 0;     ///< of rows
  double stray_m = 0;       ///< of the cutter
  double least_worth = 0;   ///< `CutPreview::cut`; rows by walls always go
  int time = 0;             ///< that directions are gone through: rows by walls are nearer to each other in each
  double worth = 0;         ///< for a length of row that it finishes, so many times as long a path is worth it
  bool is_trimmed = false;  ///< `TourTask`
  bool is_last = false;     ///< the last tool that finishes: goes into creases too
};

/// Not shared between threads.
class DirectionContours {
 public:
  /// What leans more from the axis is a wall: rows go up and down it (cosine).
  static constexpr double wall_cosine = 0.35;

  /// All must outlive it.
  DirectionContours(const DirectionTask& task, NailReach& reach, Carver& carver, const RunContext& run);

  /// A tour for some nails, once. Throws Cancelled.
  WorthwhileTour run(const std::vector<std::uint32_t>& wanted);

 private:
  RestingBall resting(std::uint32_t nail) const;
  double cosine(std::uint32_t nail) const { return reach_.cosine(nail, task_.direction); }
  void add_between(const std::vector<std::uint32_t>& wanted);
  void add_beside(const std::vector<std::uint32_t>& wanted);
  std::vector<Curve> rows() const;
  std::vector<Row> rows_by_walls() const;
  std::vector<Curve> middle_lines() const;
  void lay(const std::vector<Row>& rows, double least_worth);
  void lay(const std::vector<Curve>& curves);
  std::vector<Contour> follow(const std::vector<Row>& rows) const;
  CutPreview preview() const;

  DirectionTask task_;
  NailReach& reach_;
  Carver& carver_;
  const Nails& nails_;
  const RunContext& run_;
  CutPreview preview_;
  std::vector<RestingBall> balls_;  ///< on nails that would still be above the tolerance
  std::vector<Contour> contours_;
};

}  // namespace sculpt
