// Where above the stock a robot can hold a tool, and how deep from there.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/helpers.hpp"
#include "core/mill/drive/held_tool.hpp"
#include "core/mill/map/site.hpp"

namespace sculpt {

/// How low the robot can hold the tip, straight down from above the stock or, along a tilted axis, from where the field
/// begins. Looked up on a coarse lattice: whoever goes there finds out for sure.
class ReachFloor {
 public:
  ReachFloor(const PostureField& field, const Grid& around, const Site& site, double top, const Helpers& helpers)
      : lattice_(site.lattice()) {
    lattice_.step *= stride;
    lattice_.width = lattice_.width / stride + 2;
    lattice_.height = lattice_.height / stride + 2;
    ranges_.resize(lattice_.size());
    helpers.for_each_index(static_cast<std::size_t>(lattice_.height), [&](std::size_t row) {
      const int b = static_cast<int>(row);
      for (int a = 0; a < lattice_.width; ++a)
        ranges_[lattice_.index(a, b)] = range_below(
            field, around, site.frame(), {lattice_.low_u + a * lattice_.step, lattice_.low_v + b * lattice_.step, top});
    });
  }

  bool allows(const Vec3& at) const {
    const int a = lattice_.cell_u(at.x()), b = lattice_.cell_v(at.y());
    if (a < 0 || b < 0 || a + 1 >= lattice_.width || b + 1 >= lattice_.height) return false;
    for (const auto& [da, db] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}})
      if (const Range& range = ranges_[lattice_.index(a + da, b + db)]; range.low > at.z() || range.high < at.z())
        return false;
    return true;
  }

 private:
  static constexpr int stride = 4;
  static constexpr double step_m = 4e-3;

  /// Of a column (tool frame, m); nowhere if `low` is above `high`.
  struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;
  };

  /// Of the column that begins there (tool frame).
  static Range range_below(const PostureField& field, const Grid& around, const ToolFrame& frame, const Vec3& above) {
    const Vec3 first = HeldTool::cell_of(field, around, frame.point(above)),
               step = HeldTool::cell_of(field, around, frame.point(above - Vec3(0, 0, step_m))) - first;
    // Where it goes through the field, in steps.
    double begin = 0, end = 2 * around.n * around.voxel_m / step_m;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = -0.5 - first[axis], high = around.n - 0.5 - first[axis];
      if (std::abs(step[axis]) < 1e-9) {
        if (low > 0 || high < 0) return {};
        continue;
      }
      begin = std::max(begin, std::min(low / step[axis], high / step[axis]));
      end = std::min(end, std::max(low / step[axis], high / step[axis]));
    }
    Range range;
    for (double down = std::ceil(begin); down <= end; ++down) {
      const bool usable = field.usable(first + down * step), is_begun = range.low <= range.high;
      if (!usable && is_begun) break;
      if (!usable) continue;
      range.low = above.z() - down * step_m;
      if (!is_begun) range.high = range.low + step_m;
    }
    return range;
  }

  Lattice lattice_;
  std::vector<Range> ranges_;
};

}  // namespace sculpt
