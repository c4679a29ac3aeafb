// A cell: the room as one URDF, plus where the stock stands, the tool and the home configuration.
#pragma once

#include <filesystem>
#include <map>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/cell/chain.hpp"
#include "core/cell/controller/axis_map.hpp"
#include "core/cell/controller/joint_limits.hpp"
#include "core/cell/tool.hpp"
#include "core/material/voxel.hpp"

namespace sculpt {

/// Indices of two different links, the smaller first.
using LinkPair = std::pair<int, int>;

/// Everything a cell is made of, as bytes: it can be sent to a machine that does not share this disk.
struct CellFiles {
  std::string name;  ///< file name without extension
  std::string cell_json;
  std::map<std::string, std::string>
      files;  ///< the URDF under its name in the cell file, each mesh under its reference in the URDF
};

struct Cell {
  std::string name;
  std::string urdf;  ///< the text that `robot` was read from; empty for a cell made in code
  Robot robot;
  int stock_link = -1;
  int tool_link = -1;
  double stock_size_m = 0;             ///< edge of the grid's cube
  Vec3 stock_origin_m = Vec3::Zero();  ///< corner of voxel (0,0,0) in the stock link's frame
  bool has_post = false;  ///< the last shape of the stock link is what the cell file has the stock stand on
  ToolSpec tool;
  std::vector<double> rest;            ///< value of every robot joint at home
  std::vector<double> change;          ///< the same where milling tools are changed; empty: at home
  std::vector<LinkPair> ignore_pairs;  ///< may touch, whatever is found out about them; sorted, none twice
  std::vector<LinkPair> check_pairs;   ///< must not touch, whatever is found out about them; sorted, none twice
  std::vector<JointLimits> limits;     ///< of every robot joint
  AxisMap programs;                    ///< empty where the cell names no controller's axes

  Grid grid(int n) const { return {n, stock_size_m / n, stock_origin_m}; }
  /// The cell must outlive the chain.
  Chain chain() const { return Chain(robot, stock_link, tool_link, tool.stickout_m, rest); }
  /// Home in the coordinates of `chain`.
  Configuration home(const Chain& chain) const;
  /// Where milling tools are changed, in the same.
  Configuration change_place(const Chain& chain) const;
};

/// Reads the cell file, its URDF and every mesh it refers to. package://NAME/rest is looked for under the cell file's
/// "packages" map, else in each folder above the URDF (NAME itself or a sub-folder NAME), else in ROS_PACKAGE_PATH.
/// Throws InputError `cell_invalid` or `file_missing`.
CellFiles read_cell_files(const std::filesystem::path& path);

/// A cell that can be looked at even where its home cannot be used.
struct CellDraft {
  Cell cell;                            ///< joints whose home is at fault stand at 0, or at the limit that is nearest
  std::vector<InputError> home_faults;  ///< each names its place in the file
};

/// As parse_cell, but for what is wrong with home.
CellDraft draft_cell(const CellFiles& files);

/// With nothing in the spindle: the holder of the cell's own thin tool is taken off the tool link.
Cell without_holder(Cell cell);

/// Gives joints that mimic another one the values that follow from it; one value a joint of the robot.
void follow_leaders(const Robot& robot, std::vector<double>& values);

/// Throws InputError `cell_invalid` (unknown or missing fields with their JSON pointer, link or joint names that do not
/// exist, home outside limits) or `urdf_invalid`.
Cell parse_cell(const CellFiles& files);

}  // namespace sculpt
