#include "core/cell/chain.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/cell/link_poses.hpp"

namespace sculpt {

namespace {

/// Joints from the root down to `link`.
std::vector<int> path_from_root(const Robot& robot, int link) {
  std::vector<int> path;
  for (int joint = robot.links[static_cast<std::size_t>(link)].parent_joint; joint >= 0;) {
    path.push_back(joint);
    const int parent = robot.joints[static_cast<std::size_t>(joint)].parent_link;
    joint = robot.links[static_cast<std::size_t>(parent)].parent_joint;
  }
  std::reverse(path.begin(), path.end());
  return path;
}

Frame z_onto(const Vec3& axis) {
  return Frame(Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), axis));
}

/// frame * (turn about z by `angle`), without the products by zero.
void turn_about_z(Frame& frame, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const Vec3 x = frame.linear().col(0), y = frame.linear().col(1);
  frame.linear().col(0) = c * x + s * y;
  frame.linear().col(1) = c * y - s * x;
}

/// a * b of two rigid frames, without the fourth row.
Frame product(const Frame& a, const Frame& b) {
  Frame out;
  out.linear().noalias() = a.linear().lazyProduct(b.linear());
  out.translation() = a.linear().lazyProduct(b.translation()) + a.translation();
  out.makeAffine();
  return out;
}

}  // namespace

Chain::Chain(const Robot& robot, int stock_link, int tool_link, double stickout_m, std::vector<double> rest)
    : robot_(&robot),
      stock_link_(stock_link),
      tool_link_(tool_link),
      stickout_m_(stickout_m),
      rest_(std::move(rest)),
      coordinate_(robot.joints.size(), -1),
      stock_path_(path_from_root(robot, stock_link)) {
  const std::vector<int> tool_path = path_from_root(robot, tool_link);
  std::size_t shared = 0;
  while (shared < stock_path_.size() && shared < tool_path.size() && stock_path_[shared] == tool_path[shared]) ++shared;

  Frame fixed = Frame::Identity();
  for (std::size_t at = stock_path_.size(); at > shared; --at) add_step(stock_path_[at - 1], true, fixed);
  for (std::size_t at = shared; at < tool_path.size(); ++at) add_step(tool_path[at], false, fixed);
  last_ = fixed * Eigen::Translation3d(0, 0, stickout_m_);
  if (joints_.empty()) {
    const auto link = [&](int index) { return robot.links[static_cast<std::size_t>(index)].name; };
    throw InputError("chain_empty", "no movable joint lies between stock link '" + link(stock_link) +
                                        "' and tool link '" + link(tool_link) +
                                        "': name other links in the cell file, or give the URDF a joint between them");
  }

  lower_.resize(dof());
  upper_.resize(dof());
  for (int c = 0; c < dof(); ++c) {
    const Joint& joint = robot.joints[static_cast<std::size_t>(joints_[static_cast<std::size_t>(c)])];
    lower_[c] = joint.lower;
    upper_[c] = joint.upper;
  }
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const Joint& joint = robot.joints[j];
    if (joint.mimic < 0) continue;
    const std::size_t source = static_cast<std::size_t>(joint.mimic);
    coordinate_[j] = coordinate_[source];
    rest_[j] = joint.mimic_multiplier * rest_[source] + joint.mimic_offset;
  }
}

int Chain::add_coordinate(int joint) {
  int& coordinate = coordinate_[static_cast<std::size_t>(joint)];
  if (coordinate < 0) {
    if (dof() == max_joints)
      throw InputError("urdf_invalid", "more than " + std::to_string(max_joints) +
                                           " joints move the tool against the stock: fix some of them in the URDF");
    coordinate = dof();
    joints_.push_back(joint);
  }
  return coordinate;
}

void Chain::add_step(int index, bool on_stock_side, Frame& fixed) {
  const Joint& joint = robot_->joints[static_cast<std::size_t>(index)];
  if (joint.kind == JointKind::fixed) {
    fixed = on_stock_side ? fixed * joint.origin.inverse() : fixed * joint.origin;
    return;
  }
  const Frame to_axis = z_onto(joint.axis);
  Step step;
  step.before = on_stock_side ? fixed * to_axis : fixed * joint.origin * to_axis;
  step.turns = joint.kind == JointKind::revolute;
  step.coordinate = add_coordinate(joint.mimic >= 0 ? joint.mimic : index);
  step.multiplier = joint.mimic >= 0 ? joint.mimic_multiplier : 1;
  step.offset = joint.mimic >= 0 ? joint.mimic_offset : 0;
  if (on_stock_side) {
    step.multiplier = -step.multiplier;
    step.offset = -step.offset;
  }
  steps_.push_back(step);
  shifts_ = shifts_ || !step.turns;
  fixed = on_stock_side ? to_axis.inverse() * joint.origin.inverse() : to_axis.inverse();
}

std::vector<std::string> Chain::names() const {
  std::vector<std::string> names;
  for (int joint : joints_) names.push_back(robot_->joints[static_cast<std::size_t>(joint)].name);
  return names;
}

bool Chain::within_limits(const Configuration& q, double slack) const {
  return q.size() == lower_.size() && (q.array() >= lower_.array() - slack).all() &&
         (q.array() <= upper_.array() + slack).all();
}

bool Chain::translating() const {
  return std::all_of(joints_.begin(), joints_.end(), [this](int joint) {
    return robot_->joints[static_cast<std::size_t>(joint)].kind == JointKind::prismatic;
  });
}

double Chain::joint_value(std::size_t joint, const Configuration& q) const {
  if (coordinate_[joint] < 0) return rest_[joint];
  const double value = q[coordinate_[joint]];
  const Joint& follower = robot_->joints[joint];
  return follower.mimic < 0 ? value : follower.mimic_multiplier * value + follower.mimic_offset;
}

std::vector<double> Chain::joint_values(const Configuration& q) const {
  std::vector<double> values(robot_->joints.size());
  for (std::size_t j = 0; j < values.size(); ++j) values[j] = joint_value(j, q);
  return values;
}

void Chain::link_poses(const Configuration& q, std::vector<Frame>& poses) const {
  Frame stock_in_root = Frame::Identity();
  for (int at : stock_path_) {
    const std::size_t joint = static_cast<std::size_t>(at);
    stock_in_root = product(stock_in_root, joint_pose(robot_->joints[joint], joint_value(joint, q)));
  }
  poses.resize(robot_->links.size());
  poses[static_cast<std::size_t>(robot_->root)] = stock_in_root.inverse();
  for (std::size_t j = 0; j < robot_->joints.size(); ++j) {
    const Joint& joint = robot_->joints[j];
    const Frame& parent = poses[static_cast<std::size_t>(joint.parent_link)];
    poses[static_cast<std::size_t>(joint.child_link)] = product(parent, joint_pose(joint, joint_value(j, q)));
  }
  poses[static_cast<std::size_t>(stock_link_)] = Frame::Identity();
}

ToolPose Chain::tool_pose(const Configuration& q) const {
  Frame pose = Frame::Identity();
  for (const Step& step : steps_) {
    pose = product(pose, step.before);
    const double value = step.multiplier * q[step.coordinate] + step.offset;
    if (step.turns) {
      turn_about_z(pose, value);
    } else {
      pose.translation() += value * pose.linear().col(2);
    }
  }
  pose = product(pose, last_);
  return {pose.translation(), -pose.linear().col(2)};
}

ToolPose Chain::tool_pose(const Configuration& q, JointColumns<6>& jacobian) const {
  jacobian.setZero(6, dof());
  Frame pose = Frame::Identity();
  for (const Step& step : steps_) {
    pose = product(pose, step.before);
    const double value = step.multiplier * q[step.coordinate] + step.offset;
    const Vec3 rate = step.multiplier * pose.linear().col(2);
    auto column = jacobian.col(step.coordinate);
    if (step.turns) {
      // rate x (ball - origin): the part with the ball is added at the end, when the ball is known.
      column.head<3>() += pose.translation().cross(rate);
      column.tail<3>() += rate;
      turn_about_z(pose, value);
    } else {
      column.head<3>() += rate;
      pose.translation() += value * pose.linear().col(2);
    }
  }
  pose = product(pose, last_);
  const Vec3 ball = pose.translation();
  for (int c = 0; c < dof(); ++c) {
    const Vec3 turn = jacobian.col(c).tail<3>();
    jacobian.col(c).head<3>() += turn.cross(ball);
  }
  return {ball, -pose.linear().col(2)};
}

Configuration Chain::turn_rates() const {
  Configuration rates = Configuration::Zero(dof());
  for (const Step& step : steps_)
    if (step.turns) rates[step.coordinate] += std::abs(step.multiplier);
  return rates;
}

JointColumns<6> Chain::jacobian(const Configuration& q) const {
  JointColumns<6> jacobian;
  tool_pose(q, jacobian);
  return jacobian;
}

}  // namespace sculpt
