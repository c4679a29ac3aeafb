// A maker's robot and what is wished -> the parts of a cell, with the table at one place or another.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "core/cell/robot.hpp"
#include "core/doctor/make/cell_wishes.hpp"
#include "core/doctor/make/furnish.hpp"

namespace sculpt {

/// Of a tool that follows the voxels.
inline constexpr double ball_voxels = 0.45, shank_voxels = 0.4;

/// Makes one cell after the other. The two must outlive it.
class CellMaker {
 public:
  /// Throws InputError `urdf_invalid`, `cell_invalid`.
  CellMaker(const MakersRobot& source, const CellWishes& wishes);

  /// Of the table's top; one where it is wished or there is no table to place.
  std::vector<Vec3> places() const;

  struct Made {
    std::string urdf;  ///< the maker's, with what was added
    Cell cell;         ///< without a home
  };
  Made make(const Vec3& table_m) const;

  /// Lets links of the robot touch in all cells that are made from now on: neighbours of whose shapes nobody can tell
  /// whether the arm itself is in its own way, and links that are in contact wherever the joints stand. `cell`: one
  /// that was made, with the home by which that is found out. False if there are none that were not known.
  bool ignore_contacts(const Cell& cell);

  /// What a person did not say, in sentences.
  std::vector<std::string> remarks(const Vec3& table_m) const;

 private:
  struct IgnoredPair {
    std::string first, second, why;
  };

  bool is_beside(const Joint& joint) const;
  bool needs_nose() const { return spindle_length_m_ > 0 || std::abs(out_.z() - 1) > 1e-6; }
  double find_lowest() const;
  void slim_spindle();
  TableWish wish(const Vec3& table_m) const;
  Cell cell_of(const std::string& urdf, const std::string& stock, const std::string& tool) const;

  const MakersRobot& source_;
  const CellWishes& wishes_;
  const Robot robot_;
  std::vector<IgnoredPair> ignored_;
  int flange_ = -1;
  Vec3 out_;
  bool hangs_ = false;    ///< the arm, from what stands still
  bool has_room_ = true;  ///< a spindle that was made as slim as the wrist needs
  double arm_m_ = 0, stock_m_ = 0, stickout_m_ = 0, spindle_radius_m_ = 0, spindle_length_m_ = 0, floor_m_ = 0;
};

}  // namespace sculpt
