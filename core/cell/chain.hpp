// Kinematics from the stock link to the tool link of a Robot, whatever lies between: arm, table, rail, gantry.
#pragma once

#include <string>
#include <vector>

#include "core/cell/robot.hpp"

namespace sculpt {

/// The tool in the stock frame: `ball_m` is the ball's centre, `axis` the unit vector from the ball towards the
/// spindle.
struct ToolPose {
  Vec3 ball_m;
  Vec3 axis;
};

/// Forward kinematics in the stock frame (= the stock link's frame). Its coordinates are the independent joints on the
/// path stock link -> tool link, in path order; mimic joints follow their source (which is a coordinate even where it
/// lies off the path), all other movable joints stand at `rest` (their home value, else 0 clamped to their limits).
/// Immutable after construction: safe to share between threads.
class Chain {
 public:
  /// `rest`: value per robot joint (size robot.joints.size()). Throws InputError `chain_empty` when no joint moves the
  /// tool, `urdf_invalid` when more than max_joints do.
  Chain(const Robot& robot, int stock_link, int tool_link, double stickout_m, std::vector<double> rest);

  int dof() const { return static_cast<int>(joints_.size()); }
  /// Robot joint index of each coordinate.
  const std::vector<int>& joints() const { return joints_; }
  std::vector<std::string> names() const;
  const Configuration& lower() const { return lower_; }
  const Configuration& upper() const { return upper_; }
  bool within_limits(const Configuration& q, double slack = 0) const;
  /// True when every coordinate is prismatic: the paper's translating robot.
  bool translating() const;

  /// True when some coordinate moves a prismatic joint.
  bool shifts() const { return shifts_; }

  /// Value of every robot joint at q.
  std::vector<double> joint_values(const Configuration& q) const;
  /// Pose of every robot link in the stock frame; `poses` is resized to the number of links.
  void link_poses(const Configuration& q, std::vector<Frame>& poses) const;
  ToolPose tool_pose(const Configuration& q) const;
  /// Rows 0-2: velocity of the ball's centre (m per unit of joint); rows 3-5: angular velocity of the tool (rad per
  /// unit). Stock frame. 6 x dof.
  JointColumns<6> jacobian(const Configuration& q) const;
  /// Both at once; `jacobian` is resized where needed, so that a caller who keeps it pays no allocation.
  ToolPose tool_pose(const Configuration& q, JointColumns<6>& jacobian) const;

  /// How fast the tool can turn, per unit of each coordinate (rad): more than 1 where mimic joints add to it.
  Configuration turn_rates() const;

  /// One moving joint on the path: `before` (everything fixed since the previous one), then a turn about or shift along
  /// z by multiplier * q[coordinate] + offset. The joint's axis is turned onto z by the frames around it; joints on the
  /// stock side are passed from child to parent, so their multiplier and offset are negated.
  struct Step {
    Frame before;
    bool turns;
    int coordinate;
    double multiplier, offset;
  };
  const std::vector<Step>& steps() const { return steps_; }
  /// From the last step's frame to the ball, with -z towards the spindle.
  const Frame& last() const { return last_; }

  const Robot& robot() const { return *robot_; }
  int stock_link() const { return stock_link_; }
  int tool_link() const { return tool_link_; }
  double stickout_m() const { return stickout_m_; }

 private:
  void add_step(int joint, bool on_stock_side, Frame& fixed);
  int add_coordinate(int joint);
  double joint_value(std::size_t joint, const Configuration& q) const;

  const Robot* robot_;
  int stock_link_, tool_link_;
  double stickout_m_;
  std::vector<double> rest_;
  std::vector<int> joints_;
  std::vector<int> coordinate_;  // per robot joint: its coordinate, or -1
  Configuration lower_, upper_;
  std::vector<int> stock_path_;  // joints from the root to the stock link
  std::vector<Step> steps_;
  bool shifts_ = false;
  Frame last_ = Frame::Identity();  // from the last step's frame to the ball
};

}  // namespace sculpt
