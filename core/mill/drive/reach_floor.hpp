// Where above the stock a robot can hold a tool, and how deep from there.
#pragma once

#include <vector>

#include "core/mill/drive/held_tool.hpp"
#include "core/mill/map/site.hpp"

namespace sculpt {

/// How low the robot can hold the tip, straight down from above the stock. Looked up on a coarse lattice: whoever goes
/// there finds out for sure.
class ReachFloor {
 public:
  ReachFloor(const PostureField& field, const Grid& around, const Site& site, double top)
      : lattice_(site.lattice()), top_(top) {
    lattice_.step *= stride;
    lattice_.width = lattice_.width / stride + 2;
    lattice_.height = lattice_.height / stride + 2;
    floor_.resize(lattice_.size(), top + step_m);
    const double depth = 2 * around.n * around.voxel_m;
    for (int b = 0; b < lattice_.height; ++b)
      for (int a = 0; a < lattice_.width; ++a) {
        double& floor = floor_[lattice_.index(a, b)];
        const Vec3 above(lattice_.low_u + a * lattice_.step, lattice_.low_v + b * lattice_.step, top);
        for (double down = 0; down < depth; down += step_m) {
          const Vec3 cell = HeldTool::cell_of(field, around, site.frame().point(above - Vec3(0, 0, down)));
          const bool usable =
              (cell.array() >= -0.5).all() && (cell.array() <= around.n - 0.5).all() && field.usable(cell);
          // Above, a tilted column is outside of the field at first.
          if (!usable && floor < top + step_m) break;
          if (usable) floor = top - down;
        }
      }
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

  Lattice lattice_;
  double top_;
  std::vector<double> floor_;
};

}  // namespace sculpt
