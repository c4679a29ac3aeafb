// What a maker's URDF lacks of a cell, as more elements of it: a spindle, a table, a floor.
#pragma once

#include <set>
#include <string>

#include "core/base/frame.hpp"
#include "core/cell/robot.hpp"

namespace sculpt {

/// Names that the URDF does not have yet.
class FreeNames {
 public:
  explicit FreeNames(const Robot& robot);
  /// `name`, or with a number behind it; taken from then on.
  std::string take(const std::string& name);

 private:
  std::set<std::string> taken_;
};

/// Links that were added, by name, and the text that adds them.
struct SpindleText {
  std::string nose, elements;
};
/// A cylinder on `flange` along `out`, and a link at its nose with +z out of it. `length_m` 0: the nose alone.
SpindleText spindle_text(FreeNames& names, const std::string& flange, const Vec3& out, double radius_m,
                         double length_m);

struct TableWish {
  Vec3 top_m;  ///< the middle of its top, in the frame of the root
  double radius_m = 0;
  bool turns = true;
  double floor_m = 0;   ///< height of the floor in the frame of the root
  bool plate = true;    ///< that floor is a plate that nothing may go through
  double around_m = 0;  ///< as far as the floor goes
};
struct TableText {
  std::string stock, table_joint, elements;
};
/// A new root with post and floor, `root` fixed to it, a disc on the post, and a link for the stock on the disc.
TableText table_text(FreeNames& names, const std::string& root, const TableWish& wish);

}  // namespace sculpt
