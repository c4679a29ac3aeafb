#include "core/cell/cell.hpp"

namespace sculpt {

Cell without_holder(Cell cell) {
  auto& shapes = cell.robot.links[static_cast<std::size_t>(cell.tool_link)].shapes;
  shapes.resize(shapes.size() - holder_shapes(cell.tool).size());
  cell.tool.holder.clear();
  return cell;
}

void follow_leaders(const Robot& robot, std::vector<double>& values) {
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const Joint& joint = robot.joints[j];
    if (joint.mimic >= 0)
      values[j] = joint.mimic_multiplier * values[static_cast<std::size_t>(joint.mimic)] + joint.mimic_offset;
  }
}

namespace {

Configuration coordinates_of(const std::vector<double>& joints, const Chain& chain) {
  Configuration q(chain.dof());
  for (int c = 0; c < chain.dof(); ++c)
    q[c] = joints[static_cast<std::size_t>(chain.joints()[static_cast<std::size_t>(c)])];
  return q;
}

}  // namespace

Configuration Cell::home(const Chain& chain) const {
  return coordinates_of(rest, chain);
}

Configuration Cell::change_place(const Chain& chain) const {
  return coordinates_of(change.empty() ? rest : change, chain);
}

}  // namespace sculpt
