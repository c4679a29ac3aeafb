// What contours would do, before they are cut.
#pragma once

#include <cstdint>
#include <vector>

#include "core/mill/finish/envelope.hpp"
#include "core/mill/finish/nail_reach.hpp"
#include "core/mill/finish/nails.hpp"
#include "core/mill/map/tool_frame.hpp"

namespace sculpt {

/// Of a ball cutter that is held in one direction. Not shared between threads.
class CutPreview {
 public:
  struct Task {
    const ToolFrame& frame;
    double radius_m = 0;   ///< of the ball
    double stray_m = 0;    ///< by which it may be smaller where it cuts
    double spacing_m = 0;  ///< of rows
  };
  /// Both must outlive it; nothing may be cut while it is in use.
  CutPreview(const Task& task, const NailReach& reach, const Nails& nails)
      : task_(task), reach_(reach), nails_(nails), excesses_(nails.excesses()) {}

  /// As if they were cut, one after the other; those that are not worth it are left out. `least_worth`: of a contour's
  /// length, and of a way to it of some spacings, so much at least must be what a row would be that finishes as much
  /// surface one spacing wide.
  std::vector<Contour> cut(std::vector<Contour> contours, double least_worth);
  /// Would a nail still be above the tolerance?
  bool is_open(std::size_t nail) const { return reach_.is_open(nail, static_cast<double>(excesses_[nail])); }

 private:
  bool is_worth_it(const Contour& contour, double least_worth);

  Task task_;
  const NailReach& reach_;
  const Nails& nails_;
  std::vector<float> excesses_;
  std::vector<Nails::Change> changes_;
};

}  // namespace sculpt
