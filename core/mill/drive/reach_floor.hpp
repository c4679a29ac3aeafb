// Where above the stock a robot can hold a tool, and how deep from there.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/helpers.hpp"
#include "core/mill/drive/held_tool.hpp"
#include "core/mill/map/site.hpp"

namespace sculpt {

/// How low the robot can hold the tip, straight down from above the stock. Looked up on a coarse lattice: whoever goes
/// there finds out for sure.
class ReachFloor {
 public:
  ReachFloor(const PostureField& field, const Grid& around, const Site& site, double top, const Helpers& helpers)
      : lattice_(site.lattice()), top_(top) {
    lattice_.step *= stride;
    lattice_.width = lattice_.width / stride + 2;
    lattice_.height = lattice_.height / stride + 2;
    floor_.resize(lattice_.size(), top + step_m);
    helpers.for_each_index(static_cast<std::size_t>(lattice_.height), [&](std::size_t row) {
      const int b = static_cast<int>(row);
      for (int a = 0; a < lattice_.width; ++a)
        floor_[lattice_.index(a, b)] = floor_below(
            field, around, site.frame(), {lattice_.low_u + a * lattice_.step, lattice_.low_v + b * lattice_.step, top});
    });
  }

  bool allows(const Vec3& at) const {
    if (at.z() > top_ + step_m) return false;
    const int a = lattice_.cell_u(at.x()), b = lattice_.cell_v(at.y());
    if (a < 0 || b < 0 || a + 1 >= lattice_.width || b + 1 >= lattice_.height) return false;
    for (const auto& [da, db] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}})
      if (floor_[lattice_.index(a + da, b + db)] > at.z()) return false;
    return true;
  }

 private:
  static constexpr int stride = 4;
  static constexpr double step_m = 4e-3;

  /// Of the column that begins there (tool frame).
  static double floor_below(const PostureField& field, const Grid& around, const ToolFrame& frame, const Vec3& above) {
    const Vec3 first = HeldTool::cell_of(field, around, frame.point(above)),
               step = HeldTool::cell_of(field, around, frame.point(above - Vec3(0, 0, step_m))) - first;
    // Where it goes through the field, in steps.
    double begin = 0, end = 2 * around.n * around.voxel_m / step_m;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = -0.5 - first[axis], high = around.n - 0.5 - first[axis];
      if (std::abs(step[axis]) < 1e-9) {
        if (low > 0 || high < 0) return above.z() + step_m;
        continue;
      }
      begin = std::max(begin, std::min(low / step[axis], high / step[axis]));
      end = std::min(end, std::max(low / step[axis], high / step[axis]));
    }
    double floor = above.z() + step_m;
    for (double down = std::ceil(begin); down <= end; ++down) {
      const bool usable = field.usable(first + down * step);
      // Above, a tilted column is outside of the field at first.
      if (!usable && floor < above.z() + step_m) break;
      if (usable) floor = above.z() - down * step_m;
    }
    return floor;
  }

  Lattice lattice_;
  double top_;
  std::vector<double> floor_;
};

}  // namespace sculpt
