// What contours would do, before they are cut.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/run_context.hpp"
#include "core/mill/finish/envelope.hpp"
#include "core/mill/finish/nail_reach.hpp"
#include "core/mill/finish/nails.hpp"
#include "core/mill/map/tool_frame.hpp"

namespace sculpt {

/// Of a contour, by edge, the numbers of some nails.
using EdgeNails = std::vector<std::vector<std::uint32_t>>;

/// Of a ball cutter that is held in one direction. Not shared between threads.
class CutPreview {
 public:
  struct Task {
    const ToolFrame& frame;
    double radius_m = 0;   ///< of the ball
    double stray_m = 0;    ///< by which it may be smaller where it cuts
    double spacing_m = 0;  ///< of rows
  };
  /// All must outlive it; nothing may be cut while it is in use.
  CutPreview(const Task& task, const NailReach& reach, const Nails& nails, const RunContext& run);

  /// As if they were cut, one after the other; those that are not worth it are left out. `least_worth`: of a contour's
  /// length, and of a way to it of some spacings, so much at least must be what it serves. Throws Cancelled.
  std::vector<Contour> cut(std::vector<Contour> contours, double least_worth);
  /// Of a contour, by edge, the nails, open until now, that this edge finishes alone. Any thread. Throws Cancelled.
  EdgeNails finished_by_edges(const Contour& contour) const;
  /// What finishes one nail serves as much surface as so long a row (m) one spacing wide.
  double nail_m() const { return nails_.area_m2() / task_.spacing_m; }
  /// How many nails there are.
  std::size_t nails() const { return nails_.size(); }
  /// Would a nail still be above the tolerance?
  bool is_open(std::size_t nail) const { return is_open_[nail] != 0; }

 private:
  std::vector<std::uint32_t> finished_by(const Contour& contour) const;

  Task task_;
  const NailReach& reach_;
  const Nails& nails_;
  const RunContext& run_;
  std::vector<char> is_open_;
};

}  // namespace sculpt
