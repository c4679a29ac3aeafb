#include "core/place/stand.hpp"

#include <algorithm>
#include <sstream>
#include <utility>
#include <vector>

#include "core/base/error.hpp"

namespace sculpt {
namespace {

/// Joints from the root to the link.
std::vector<int> way_to(const Robot& robot, int link) {
  std::vector<int> way;
  for (int joint = robot.links[static_cast<std::size_t>(link)].parent_joint; joint >= 0;
       joint = robot.links[static_cast<std::size_t>(robot.joints[static_cast<std::size_t>(joint)].parent_link)]
                   .parent_joint)
    way.push_back(joint);
  std::reverse(way.begin(), way.end());
  return way;
}

struct Ways {
  std::vector<int> stock, tool;  ///< joints from where the two part
};

Ways find_ways(const Cell& cell) {
  Ways ways{way_to(cell.robot, cell.stock_link), way_to(cell.robot, cell.tool_link)};
  const auto [stock, tool] = std::mismatch(ways.stock.begin(), ways.stock.end(), ways.tool.begin(), ways.tool.end());
  ways.stock.erase(ways.stock.begin(), stock);
  ways.tool.erase(ways.tool.begin(), tool);
  return ways;
}

const std::string& link_name(const Cell& cell, int link) {
  return cell.robot.links[static_cast<std::size_t>(link)].name;
}

int find_table_joint(const Cell& cell, const std::vector<int>& way) {
  if (way.empty())
    throw InputError("cell_invalid", "cell '" + cell.name + "': no joint carries the stock's link '" +
                                         link_name(cell, cell.stock_link) +
                                         "' away from the robot, so no table can be moved: put a link and a fixed "
                                         "joint under it in the URDF, or move the base");
  const auto moves = std::find_if(way.begin(), way.end(), [&](int joint) {
    return cell.robot.joints[static_cast<std::size_t>(joint)].kind != JointKind::fixed;
  });
  return moves == way.end() ? way.front() : *moves;
}

int find_base_joint(const Cell& cell, const std::vector<int>& way) {
  const auto kind = [&](int joint) { return cell.robot.joints[static_cast<std::size_t>(joint)].kind; };
  const auto turns =
      std::find_if(way.begin(), way.end(), [&](int joint) { return kind(joint) == JointKind::revolute; });
  for (auto at = turns; at != way.begin();) {
    --at;
    const bool moves_beyond = std::any_of(at, way.end(), [&](int joint) { return kind(joint) != JointKind::fixed; });
    if (kind(*at) == JointKind::fixed && moves_beyond) return *at;
  }
  if (!way.empty() && kind(way.front()) == JointKind::prismatic) return way.front();
  throw InputError("cell_invalid",
                   "cell '" + cell.name + "': no fixed joint carries the robot" +
                       (way.empty() ? std::string()
                                    : ", the way to the tool begins with joint '" +
                                          cell.robot.joints[static_cast<std::size_t>(way.front())].name + "'") +
                       ": put a link and a fixed joint under the robot's first link in the URDF, or move the table");
}

}  // namespace

int find_moved_joint(const Cell& cell, Moved moved) {
  const Ways ways = find_ways(cell);
  return moved == Moved::table ? find_table_joint(cell, ways.stock) : find_base_joint(cell, ways.tool);
}

int find_moved_joint(const Cell& cell, const std::string& name) {
  const Ways ways = find_ways(cell);
  std::string names;
  for (const std::vector<int>* way : {&ways.stock, &ways.tool})
    for (const int joint : *way) {
      const std::string& other = cell.robot.joints[static_cast<std::size_t>(joint)].name;
      if (other == name) return joint;
      names += (names.empty() ? "" : ", ") + other;
    }
  throw InputError("cell_invalid", "cell '" + cell.name + "': moving joint '" + name +
                                       "' does not move the stock against the tool: name one of " + names);
}

Stand stand_of(const Cell& cell, int joint) {
  return {cell.robot.joints[static_cast<std::size_t>(joint)].origin.translation(), 0, cell.stock_origin_m.z(),
          cell.tool.stickout_m};
}

Frame origin_at(const Robot& robot, int joint, const Stand& stand) {
  Frame origin = Frame::Identity();
  origin.linear() = Eigen::AngleAxisd(stand.turn_rad, Vec3::UnitZ()).toRotationMatrix() *
                    robot.joints[static_cast<std::size_t>(joint)].origin.linear();
  origin.translation() = stand.at_m;
  return origin;
}

Cell cell_at(const Cell& cell, int joint, const Stand& stand) {
  double holder_m = 0;
  for (const HolderSection& section : cell.tool.holder) holder_m += section.length_m;
  if (stand.stickout_m <= holder_m && !cell.tool.holder.empty()) {
    std::ostringstream text;
    text << "cell '" << cell.name << "': a tool that sticks out by " << stand.stickout_m << " m is no longer than its "
         << holder_m << " m of holder: ask for longer ones";
    throw InputError("cell_invalid", text.str());
  }
  Cell moved = cell;
  moved.urdf.clear();
  moved.robot.joints[static_cast<std::size_t>(joint)].origin = origin_at(cell.robot, joint, stand);
  moved.stock_origin_m.z() = stand.height_m;
  moved.tool.stickout_m = stand.stickout_m;
  return moved;
}

}  // namespace sculpt
