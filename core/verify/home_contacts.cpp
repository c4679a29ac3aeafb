#include "core/verify/home_contacts.hpp"

#include "core/verify/robot/checked_pairs.hpp"

namespace sculpt {

std::vector<LinkPair> find_home_contacts(const Cell& cell, const std::vector<int>& joints) {
  const LinkMotion motion(cell.robot, joints, cell.rest, cell.stock_link);
  const std::vector<SolidBody> bodies = make_solid_bodies(cell.robot);
  return choose_pairs(cell, joints, motion, bodies).contacts;
}

std::string describe_home_contact(const Robot& robot, const LinkPair& links) {
  const auto name = [&](int link) { return "link " + robot.links[static_cast<std::size_t>(link)].name; };
  return name(links.first) + " and " + name(links.second) +
         " touch at home, and not where a joint holds them together: if they may, name them in the cell's ignore_pairs";
}

}  // namespace sculpt
