// Contours over the part -> strokes of the tip, one contour after the other.
#pragma once

#include <utility>
#include <vector>

#include "core/cell/milling/mill_tool.hpp"
#include "core/mill/chip_load.hpp"
#include "core/mill/drive/mill_stroke.hpp"
#include "core/mill/finish/envelope.hpp"
#include "core/mill/map/site.hpp"
#include "core/trajectory/milling/swept_set.hpp"

namespace sculpt {

/// Goes over to the next contour along the surface where that is short, else up, over and down. Not shared between
/// threads.
class ContourStrokes {
 public:
  /// What the strokes must keep to; it must outlive the object.
  struct Task {
    const Site& site;
    const EnvelopeTask& envelope;
    const MillTool& tool;
    const SweptCutter& swept;  ///< its cutter, in the site's direction
    double voxel_m = 0;        ///< of the stock
    double stray_m = 0;        ///< of the cutter
    double beside_m = 0;       ///< a contour that begins no farther away may be gone to along the surface
    double min_height = 0;     ///< of ways over
  };
  /// `at`: where the tip is, in the air. `stock`: what was not cut yet.
  ContourStrokes(const Task& task, SweptSet stock, const Vec3& at)
      : task_(task), stock_(std::move(stock)), load_(counted_load(task.tool, task.voxel_m)), at_(at) {}

  /// Along the surface to where a contour begins, the tip being down; nothing where that is no short way. Any thread.
  Contour way_to(const Vec3& to) const;
  /// By a way to it, or from above where that is empty: straight over, or by `air`, whose last place is above it. Left
  /// out is where the cutter would take off more than it may at once.
  void lay(const Contour& contour, const Contour& way, const std::vector<Vec3>& air);

  /// Did it lay any contour?
  bool has_laid() const { return has_laid_; }
  /// Is it at rest on the part?
  bool is_down() const { return is_down_; }
  /// Where the tip is after them (tool frame).
  const Vec3& at() const { return at_; }
  const std::vector<MillStroke>& strokes() const { return strokes_; }
  /// Those that were laid since the last time; what comes goes on from there.
  std::vector<MillStroke> take_strokes() { return std::exchange(strokes_, {}); }

 private:
  Contour way_over(const Vec3& to) const;
  void add(const Contour& contour);
  void go_by_air(const std::vector<Vec3>& air);
  bool let_down(const Vec3& to);
  void cut(const Vec3& to);
  bool cut_in_layers(const Vec3& to);
  bool go(const Contour& way);
  double take(const Vec3& from, const Vec3& to);

  Task task_;
  SweptSet stock_;
  SweptSet::Taken taken_;  ///< by the last way
  ChipLoad load_;
  Vec3 at_;
  bool has_laid_ = false;
  bool is_down_ = false;  ///< at rest on the part
  std::vector<MillStroke> strokes_;
};

}  // namespace sculpt
