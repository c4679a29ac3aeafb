#include "core/doctor/make/cell_maker.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/base/error.hpp"
#include "core/cell/link_poses.hpp"
#include "core/collision/link_pairs.hpp"
#include "core/collision/shape/motion_bound.hpp"
#include "core/collision/wide_contacts.hpp"
#include "core/doctor/describe_cell.hpp"
#include "core/doctor/make/find_tool.hpp"
#include "core/doctor/make/urdf_text.hpp"
#include "core/doctor/metres.hpp"
#include "core/verify/home_contacts.hpp"

namespace sculpt {
namespace {

// Of what nobody wished: shares of the arm's length and of the stock's edge.
constexpr double stock_of_arm = 1.0 / 7, stickout_of_stock = 1.1, spindle_radius_of_stock = 0.16,
                 spindle_length_of_stock = 0.7, table_radius_of_stock = 0.5;
constexpr std::array far_of_arm{0.4, 0.5, 0.6, 0.7}, high_of_arm{0.05, 0.2, 0.35, 0.5};
// Of an arm that hangs: the table stands below it, on a floor that is so far down.
constexpr std::array far_of_hanging_arm{0.0, 0.2, 0.4, 0.55};
constexpr double floor_below_hanging_arm = 1.15;

std::string in_metres(const Vec3& v) {
  char text[96];
  const Vec3 settled = (v.array().abs() < 5e-7).select(0, v);
  std::snprintf(text, sizeof text, "x %.3g, y %.3g, z %.3g m", settled.x(), settled.y(), settled.z());
  return text;
}

double to_cm(double metres) {
  return std::max(0.01, std::round(100 * metres) / 100);
}

int link_named(const Robot& robot, const std::string& name) {
  const int link = robot.find_link(name);
  if (link >= 0) return link;
  std::string names;
  for (const Link& each : robot.links) names += (names.empty() ? "" : ", ") + each.name;
  throw InputError("cell_invalid", "the URDF has no link '" + name + "'; its links are: " + names);
}

/// Of the pairs that the planner lets touch, those that the replay would find in contact.
std::vector<LinkPair> everywhere_in_contact(const Cell& cell, const std::vector<UncheckedLinks>& unchecked) {
  std::vector<LinkPair> found = find_home_contacts(cell, cell.chain().joints());
  std::erase_if(found, [&](const LinkPair& links) {
    return std::ranges::find(unchecked, links, &UncheckedLinks::links) == unchecked.end();
  });
  return found;
}

std::vector<double> rest_of(const Robot& robot) {
  std::vector<double> rest;
  for (const Joint& joint : robot.joints)
    rest.push_back(joint.kind == JointKind::fixed ? 0.0 : std::clamp(0.0, joint.lower, joint.upper));
  follow_leaders(robot, rest);
  return rest;
}

}  // namespace

CellMaker::CellMaker(const MakersRobot& source, const CellWishes& wishes)
    : source_(source), wishes_(wishes), robot_(parse_urdf(source.urdf, source.read_mesh)) {
  flange_ = wishes.tool_link.empty() ? find_flange(robot_) : link_named(robot_, wishes.tool_link);
  if (flange_ == robot_.root)
    throw InputError("cell_invalid", "no joint of the URDF moves a tool: name the tool's link with --tool-link");
  if (!wishes.stock_link.empty()) link_named(robot_, wishes.stock_link);
  out_ = find_way_out(robot_, flange_);
  arm_m_ = find_arm_length(robot_, flange_);
  stock_m_ = wishes.stock_size_m.value_or(to_cm(stock_of_arm * arm_m_));
  stickout_m_ = wishes.stickout_m.value_or(stickout_of_stock * stock_m_);
  spindle_radius_m_ = wishes.spindle_radius_m.value_or(spindle_radius_of_stock * stock_m_);
  spindle_length_m_ = wishes.spindle_length_m.value_or(spindle_length_of_stock * stock_m_);
  const double lowest_m = find_lowest();
  hangs_ = find_mean_place(robot_, flange_).z() < lowest_m;
  floor_m_ = hangs_ ? std::round((lowest_m - floor_below_hanging_arm * arm_m_) * 1000) / 1000 : lowest_m;
  if (!wishes.spindle_radius_m && spindle_length_m_ > 0) slim_spindle();
}

/// Until it is in no link that two joints or more are between, wherever they stand: a flange may be in a fork that is
/// narrower than the spindle which the stock asks for.
void CellMaker::slim_spindle() {
  constexpr double slimmer = 0.75, least_of_stock = 0.02;
  const auto is_stuck = [&](const Cell& cell, const Chain& chain, const LinkPair& links) {
    const auto is_added = [&](int link) {
      return robot_.find_link(cell.robot.links[static_cast<std::size_t>(link)].name) < 0;
    };
    return is_added(links.first) != is_added(links.second) && find_drives(chain, links.first, links.second).size() > 1;
  };
  for (has_room_ = false; spindle_radius_m_ > least_of_stock * stock_m_; spindle_radius_m_ *= slimmer) {
    const Cell cell = make(places().front()).cell;
    const Chain chain = cell.chain();
    has_room_ = std::ranges::none_of(find_link_pairs(cell).unchecked,
                                     [&](const UncheckedLinks& pair) { return is_stuck(cell, chain, pair.links); });
    if (has_room_) return;
  }
}

std::vector<Vec3> CellMaker::places() const {
  if (wishes_.table == Table::none) return {Vec3::Zero()};
  if (wishes_.table_at_m) return {*wishes_.table_at_m};
  const std::vector<Frame> at = link_poses(robot_, rest_of(robot_));
  Vec3 ahead = at[static_cast<std::size_t>(flange_)].translation();
  ahead.z() = 0;
  ahead = ahead.norm() < 0.1 * arm_m_ ? Vec3::UnitX() : Vec3(ahead.normalized());
  std::vector<Vec3> places;
  for (const double far : hangs_ ? far_of_hanging_arm : far_of_arm)
    for (const double high : high_of_arm) {
      const Vec3 place = far * arm_m_ * ahead + (floor_m_ + high * arm_m_) * Vec3::UnitZ();
      places.emplace_back((place * 100).array().round() / 100 + 0.0);
    }
  return places;
}

CellMaker::Made CellMaker::make(const Vec3& table_m) const {
  FreeNames names(robot_);
  Made made;
  made.urdf = source_.urdf;
  std::string stock = wishes_.stock_link, tool = robot_.links[static_cast<std::size_t>(flange_)].name, elements;
  if (needs_nose()) {
    const SpindleText spindle = spindle_text(names, tool, out_, spindle_radius_m_, spindle_length_m_);
    tool = spindle.nose;
    elements += spindle.elements;
  }
  if (wishes_.table != Table::none) {
    const TableText table = table_text(names, robot_.links[static_cast<std::size_t>(robot_.root)].name, wish(table_m));
    stock = table.stock;
    elements += table.elements;
  }
  if (!elements.empty()) made.urdf = with_elements(source_.urdf, "\n" + elements);
  made.cell = cell_of(made.urdf, stock, tool);
  return made;
}

std::vector<std::string> CellMaker::remarks(const Vec3& table_m) const {
  std::vector<std::string> said;
  const std::string flange = robot_.links[static_cast<std::size_t>(flange_)].name;
  if (wishes_.tool_link.empty())
    said.push_back("the tool sits on '" + flange + "', the end of the longest row of joints");
  if (std::abs(out_.z() - 1) > 1e-3)
    said.push_back("out of '" + flange + "' is along (" + in_metres(out_).substr(0, in_metres(out_).size() - 2) +
                   ") of its frame, by its last joint");
  if (needs_nose() && spindle_length_m_ > 0 && !wishes_.spindle_length_m)
    said.push_back("a spindle of " + in_metres(2 * spindle_radius_m_) + " by " + in_metres(spindle_length_m_) +
                   " is assumed on it: give yours with --spindle");
  if (!has_room_)
    said.push_back(
        "a spindle of any width touches the wrist: give a link farther out with --tool-link, or leave the "
        "spindle out with --spindle 0,0");
  if (!wishes_.stickout_m) said.push_back("a tool that sticks out by " + in_metres(stickout_m_) + " is assumed");
  if (!wishes_.stock_size_m) said.push_back("a stock of " + in_metres(stock_m_) + " is assumed");
  if (wishes_.table != Table::none && !wishes_.table_at_m)
    said.push_back("the middle of the table's top is put at " + in_metres(table_m) + " of '" +
                   robot_.links[static_cast<std::size_t>(robot_.root)].name + "'");
  for (const IgnoredPair& pair : ignored_)
    said.push_back("'" + pair.first + "' and '" + pair.second + "' " + pair.why +
                   ": may touch (\"ignore_pairs\"), as their shapes seem to be thicker than the arm; take them out of "
                   "that list if the arm can touch itself there");
  for (const Joint& joint : robot_.joints)
    if (is_beside(joint))
      said.push_back("nothing drives joint '" + joint.name + "' that moves '" +
                     robot_.links[static_cast<std::size_t>(joint.child_link)].name +
                     "' beside the arm: it stays where it is, take it out with --without if it is in the way");
  for (const int link : find_occupants(robot_, flange_))
    said.push_back("'" + robot_.links[static_cast<std::size_t>(link)].name + "' hangs on '" + flange +
                   "' too: take it out with --without if it goes when the spindle comes");
  return said;
}

/// Can it move, though neither the flange nor the stock hangs on it?
bool CellMaker::is_beside(const Joint& joint) const {
  const auto carries = [&](int link) {
    while (link >= 0 && link != joint.child_link) {
      const int above = robot_.links[static_cast<std::size_t>(link)].parent_joint;
      link = above < 0 ? -1 : robot_.joints[static_cast<std::size_t>(above)].parent_link;
    }
    return link >= 0;
  };
  if (joint.kind == JointKind::fixed || joint.mimic >= 0 || carries(flange_)) return false;
  return wishes_.stock_link.empty() || !carries(robot_.find_link(wishes_.stock_link));
}

/// The lowest point of what stands still with the root.
double CellMaker::find_lowest() const {
  const std::vector<int> group = rigid_groups(robot_);
  const std::vector<Frame> at = link_poses(robot_, rest_of(robot_));
  double lowest = 1e9;
  for (std::size_t link = 0; link < group.size(); ++link)
    for (const Shape& shape : robot_.links[link].shapes) {
      if (group[link] != group[static_cast<std::size_t>(robot_.root)]) continue;
      const Eigen::AlignedBox3d box = box_around(shape);
      for (int corner = 0; corner < 8; ++corner)
        lowest = std::min(lowest, (at[link] * box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner))).z());
    }
  return lowest < 1e8 ? std::round(lowest * 1000) / 1000 : 0;
}

TableWish CellMaker::wish(const Vec3& table_m) const {
  return {table_m,
          wishes_.table_radius_m.value_or(table_radius_of_stock * stock_m_),
          wishes_.table == Table::turntable,
          floor_m_,
          wishes_.floor,
          1.2 * arm_m_};
}

Cell CellMaker::cell_of(const std::string& urdf, const std::string& stock, const std::string& tool) const {
  Cell cell;
  cell.urdf = urdf;
  cell.robot = parse_urdf(urdf, source_.read_mesh);
  cell.name = cell.robot.name;
  cell.stock_link = link_named(cell.robot, stock);
  cell.tool_link = link_named(cell.robot, tool);
  cell.stock_size_m = stock_m_;
  cell.stock_origin_m = {-stock_m_ / 2, -stock_m_ / 2, 0};
  cell.tool.stickout_m = stickout_m_;
  cell.tool.in_voxels = !wishes_.ball_radius_m.has_value();
  cell.tool.ball_radius = wishes_.ball_radius_m.value_or(ball_voxels);
  cell.tool.shank_radius = wishes_.ball_radius_m.value_or(shank_voxels);
  cell.rest = rest_of(cell.robot);
  for (const IgnoredPair& pair : ignored_)
    cell.ignore_pairs.push_back(std::minmax(link_named(cell.robot, pair.first), link_named(cell.robot, pair.second)));
  std::ranges::sort(cell.ignore_pairs);
  // Two shapes of a pair may touch everywhere and two others along most of the travel.
  cell.ignore_pairs.erase(std::unique(cell.ignore_pairs.begin(), cell.ignore_pairs.end()), cell.ignore_pairs.end());
  return cell;
}

bool CellMaker::ignore_contacts(const Cell& cell) {
  const std::size_t known = ignored_.size();
  const LinkPairs pairs = find_link_pairs(cell);
  for (const LinkPair& contact : everywhere_in_contact(cell, pairs.unchecked)) {
    const std::string& first = cell.robot.links[static_cast<std::size_t>(contact.first)].name;
    const std::string& second = cell.robot.links[static_cast<std::size_t>(contact.second)].name;
    if (robot_.find_link(first) >= 0 && robot_.find_link(second) >= 0)
      ignored_.push_back({first, second, "touch wherever the joints were tried, and not at a joint's axis"});
  }
  for (const WideContact& contact : find_wide_contacts(cell, pairs.checked)) {
    const std::string& first = cell.robot.links[static_cast<std::size_t>(contact.links.first)].name;
    const std::string& second = cell.robot.links[static_cast<std::size_t>(contact.links.second)].name;
    // Of a spindle or a table that was added here all is known.
    if (robot_.find_link(first) < 0 || robot_.find_link(second) < 0) continue;
    ignored_.push_back({first, second, describe(contact, cell.robot)});
  }
  return ignored_.size() > known;
}

}  // namespace sculpt
