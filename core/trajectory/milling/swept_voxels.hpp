// Which voxels a straight motion of a cutter sweeps, decided in whole numbers: the same for all who read a plan.
//
// A cutter is taken as its ball (that of a ball cutter) and cylinders about its axis, each over a range of heights. It
// has swept a point if, on the way, the point was in the ball, or if it is within a cylinder's radius of the axis
// somewhere on the way and within its heights at both ends of the way:
//
//        |     |         |     |       heights count from the base: the centre of the ball, or of a bull-nose
//        |  x  | ......  |     |       cutter's rim; a flat cutter's is its tip
//      --|--o--|---------|--o--|--     x: swept by the cylinder; it is above both bases
//         \___/           \___/        what the ball alone reaches is a capsule about the way of the base
//
// That is a part of what is really swept (of a bull-nose cutter's rim three cylinders are counted), never more.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/cell/milling/mill_tool.hpp"
#include "core/material/voxel_set.hpp"
#include "core/trajectory/milling/quanta_point.hpp"

namespace sculpt {

/// The centres of a grid's voxels, rounded to quanta: along each axis origin + (2 i + 1) size / (2 n).
class VoxelCentres {
 public:
  explicit VoxelCentres(const Grid& grid);

  int n() const { return n_; }
  std::int64_t at(std::size_t axis, int index) const { return centres_[axis][static_cast<std::size_t>(index)]; }
  /// Numbers of the first and the last that are within [low, high] along an axis; none if first > last.
  std::array<int, 2> between(std::size_t axis, double low, double high) const;

 private:
  int n_;
  double origin_[3], step_;
  std::array<std::vector<std::int64_t>, 3> centres_;
};

/// A cutter held in one direction, made smaller by a margin on all sides. Immutable.
class SweptCutter {
 public:
  /// `direction`: from the tip towards the spindle; components of at most 1000. `less_m`: the margin.
  SweptCutter(const Cutter& cutter, const std::array<int, 3>& direction, double less_m);

  /// A run of voxels along x whose centres are swept.
  struct Run {
    int first, last, j, k;
  };
  /// On the way from `from` to `to` (tips, neither farther than max_tip_m from the origin). Calls `visit` with runs
  /// that together hold the swept voxels, some perhaps twice; rows in which `any` stands nowhere are passed over.
  template <typename Visit>
  void for_each_run(const VoxelCentres& centres, const QuantaPoint& from, const QuantaPoint& to, const VoxelSet& any,
                    const Visit& visit) const {
    const Sweep sweep(*this, from, to);
    const Box box = sweep.box(centres);
    if (box.first[0] > box.last[0]) return;  // beside the grid
    for (int k = box.first[2]; k <= box.last[2]; ++k)
      for (int j = box.first[1]; j <= box.last[1]; ++j) {
        if (!any_in_row(any, box.first[0], box.last[0], j, k)) continue;
        for (std::size_t part = 0; part < parts(); ++part)
          if (const auto [first, last] = sweep.row(part, centres, j, k); first <= last) visit(Run{first, last, j, k});
      }
  }

  /// Is the point swept?
  bool sweeps(const QuantaPoint& from, const QuantaPoint& to, const QuantaPoint& point) const;

 private:
  struct Cylinder {
    std::int64_t radius, low;  ///< low: above the base, times the length of `direction_`
  };
  struct Box {
    std::array<int, 3> first, last;
  };
  using Range = std::array<double, 2>;  ///< of x; none if first > last
  /// b of a + b x.
  struct LinearTerm {
    explicit LinearTerm(double value) : by_x(value), inverse(1 / value) {}
    /// Where low <= a + b x <= high.
    Range between(double low, double high, double a) const;

    double by_x, inverse;
  };
  /// c of a + b x + c x^2; c >= 0.
  struct SquareTerm {
    explicit SquareTerm(double value) : c(value), half_inverse(1 / (2 * value)) {}
    /// Where that is 0 or less.
    Range below(double a, double b) const;

    double c, half_inverse;
  };
  /// One motion.
  class Sweep {
   public:
    Sweep(const SweptCutter& cutter, const QuantaPoint& from, const QuantaPoint& to);
    Box box(const VoxelCentres& centres) const;
    /// The swept voxels of a row by one part: an interval, as the part and its way are convex.
    std::array<int, 2> row(std::size_t part, const VoxelCentres& centres, int j, int k) const;
    bool contains(std::size_t part, const QuantaPoint& point) const;

   private:
    Range about(std::size_t part, double y, double z) const;
    Range about_ball(double y, double z) const;
    Range about_cylinder(const Cylinder& cylinder, double y, double z) const;
    Range within_heights(double low, double y, double z) const;

    const SweptCutter& cutter_;
    QuantaPoint base_, way_;
    std::int64_t way_length2_, way_rise_;
    // In quanta, rounded: for bounds.
    Vec3 go_, axis_;          ///< way; direction, a unit vector
    double inverse_length2_;  ///< of the way
    LinearTerm along_go_, along_axis_;
    SquareTerm about_go_, about_axis_;
    Vec3 across_, beside_;  ///< the way, and a unit vector, both across the axis, and across each other
    double across2_;        ///< length of `across_`, squared
    LinearTerm along_across_, along_beside_;
  };
  std::size_t parts() const { return cylinders_.size() + (ball_radius_ > 0 ? 1 : 0); }
  static bool any_in_row(const VoxelSet& set, int first, int last, int j, int k);

  std::array<std::int64_t, 3> direction_;
  std::int64_t direction_length2_;
  QuantaPoint to_base_;           ///< from the tip
  std::int64_t ball_radius_ = 0;  ///< 0: none
  std::int64_t high_ = 0;         ///< of ball and cylinders, as that of a cylinder
  std::vector<Cylinder> cylinders_;
  std::int64_t reach_ = 0;  ///< no part is farther from the way of the base than this, across it
  double top_ = 0;          ///< of the cylinders, above the base
};

}  // namespace sculpt
