// A few lines above 300: the one file that knows the types of urdfdom.
#include "core/cell/robot.hpp"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <sstream>

#include "core/base/error.hpp"
#include "core/cell/mesh_shelf.hpp"
#include "core/cell/urdf/urdf_guard.hpp"

namespace sculpt {

namespace {

std::string joint_named(const std::string& name) {
  return "joint '" + name + "'";
}

/// What urdfdom has to say goes to console_bridge, which is one for the whole process.
class CollectedMessages : public console_bridge::OutputHandler {
 public:
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level < console_bridge::CONSOLE_BRIDGE_LOG_ERROR) return;
    if (!text_.empty()) text_ += "; ";
    text_ += text;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

urdf::ModelInterfaceSharedPtr parse_model(const std::string& xml) {
  check_urdf(xml);
  static std::mutex console_mutex;
  const std::lock_guard lock(console_mutex);
  CollectedMessages messages;
  console_bridge::useOutputHandler(&messages);
  urdf::ModelInterfaceSharedPtr model;
  std::string thrown;
  try {
    model = urdf::parseURDF(xml);
  } catch (const std::exception& error) {
    thrown = error.what();
  }
  console_bridge::restorePreviousOutputHandler();
  // A link of which urdfdom cannot read one visual or collision element stays in the model without any shape: never go
  // on with it.
  if (model && messages.text().empty()) return model;
  const std::string why = !messages.text().empty() ? messages.text() : !thrown.empty() ? thrown : "not XML";
  refuse_urdf("the URDF cannot be parsed: " + why);
}

Vec3 to_vector(const urdf::Vector3& v) {
  return {v.x, v.y, v.z};
}

Frame to_frame(const urdf::Pose& pose, const std::string& owner) {
  const Eigen::Quaterniond turn(pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z);
  const Vec3 shift = to_vector(pose.position);
  if (!shift.allFinite() || !turn.coeffs().allFinite() || turn.norm() < 0.5) {
    refuse_urdf("the <origin> of " + owner + " is not finite: give numbers for xyz (m) and rpy (rad)");
  }
  return Eigen::Translation3d(shift) * turn.normalized();
}

void require_size(double value, const char* what, const std::string& owner) {
  if (std::isfinite(value) && value > 0 && value <= max_body_m) return;
  std::ostringstream text;
  text << "the " << what << " of a collision shape of " << owner << " is " << value << ": it must be above 0 m";
  if (value > max_body_m) text << ", and at most " << max_body_m << " m: lengths in a URDF are metres, not millimetres";
  refuse_urdf(text.str());
}

Shape to_shape(const urdf::Collision& collision, const std::string& owner, MeshShelf& meshes) {
  Shape shape;
  shape.pose = to_frame(collision.origin, "a collision shape of " + owner);
  if (!collision.geometry)
    refuse_urdf("a <collision> of " + owner + " has no <geometry>: give it a box, cylinder, sphere or mesh");
  switch (collision.geometry->type) {
    case urdf::Geometry::SPHERE:
      shape.kind = ShapeKind::sphere;
      shape.radius_m = static_cast<const urdf::Sphere&>(*collision.geometry).radius;
      require_size(shape.radius_m, "radius", owner);
      break;
    case urdf::Geometry::BOX:
      shape.kind = ShapeKind::box;
      shape.sides_m = to_vector(static_cast<const urdf::Box&>(*collision.geometry).dim);
      for (double side : shape.sides_m) require_size(side, "side", owner);
      break;
    case urdf::Geometry::CYLINDER: {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(*collision.geometry);
      shape.kind = ShapeKind::cylinder;
      shape.radius_m = cylinder.radius;
      shape.length_m = cylinder.length;
      require_size(shape.radius_m, "radius", owner);
      require_size(shape.length_m, "length", owner);
      break;
    }
    case urdf::Geometry::MESH: {
      const auto& mesh = static_cast<const urdf::Mesh&>(*collision.geometry);
      shape.kind = ShapeKind::mesh;
      shape.mesh_file = mesh.filename;
      shape.mesh_scale = to_vector(mesh.scale);
      shape.mesh = meshes.get(shape.mesh_file, shape.mesh_scale, owner);
      break;
    }
  }
  return shape;
}

void set_limits(Joint& joint, const urdf::Joint& source) {
  if (source.limits) joint.max_speed = source.limits->velocity;
  if (!std::isfinite(joint.max_speed) || joint.max_speed < 0) {
    refuse_urdf("the velocity limit of " + joint_named(joint.name) + " must be a number of at least 0");
  }
  if (source.type == urdf::Joint::CONTINUOUS) {
    joint.lower = -2 * std::numbers::pi;
    joint.upper = 2 * std::numbers::pi;
    return;
  }
  if (source.limits) {
    joint.lower = source.limits->lower;
    joint.upper = source.limits->upper;
  }
  if (!std::isfinite(joint.lower) || !std::isfinite(joint.upper) || joint.lower >= joint.upper) {
    if (joint.lower > joint.upper)
      refuse_urdf(joint_named(joint.name) + " has a lower limit above its upper one: swap them");
    refuse_urdf(
        joint_named(joint.name) +
        " has no range to move in: give it <limit lower=... upper=.../> with lower below upper, or make it fixed");
  }
  constexpr double max_limit = 10'000;  // proofs over a whole range take longer the wider it is
  if (std::max(-joint.lower, joint.upper) > max_limit) {
    std::ostringstream text;
    text << joint_named(joint.name) << " goes from " << joint.lower << " to " << joint.upper
         << " rad or m, and more than " << max_limit << " either way is no joint of a robot: correct its <limit>"
         << (joint.kind == JointKind::revolute ? ", or make it continuous" : "");
    refuse_urdf(text.str());
  }
}

Joint to_joint(const urdf::Joint& source) {
  Joint joint;
  joint.name = source.name;
  joint.origin = to_frame(source.parent_to_joint_origin_transform, joint_named(source.name));
  switch (source.type) {
    case urdf::Joint::FIXED:
      return joint;
    case urdf::Joint::REVOLUTE:
    case urdf::Joint::CONTINUOUS:
      joint.kind = JointKind::revolute;
      break;
    case urdf::Joint::PRISMATIC:
      joint.kind = JointKind::prismatic;
      break;
    case urdf::Joint::FLOATING:
      refuse_urdf(joint_named(source.name) +
                  " is floating: only fixed, revolute, continuous and prismatic joints are known");
    case urdf::Joint::PLANAR:
      refuse_urdf(joint_named(source.name) + " is planar: use two prismatic joints and a revolute one instead");
    default:
      refuse_urdf(joint_named(source.name) + " has no known type: use fixed, revolute, continuous or prismatic");
  }
  const Vec3 axis = to_vector(source.axis);
  if (!axis.allFinite() || axis.norm() < 1e-9) {
    refuse_urdf("the axis of " + joint_named(joint.name) +
                " has no direction: give <axis xyz=.../> a vector that is not zero");
  }
  joint.axis = axis.normalized();
  set_limits(joint, source);
  return joint;
}

/// Follows mimics of mimics to the joint that is free, and hands limits of the followers on to it.
void resolve_mimics(Robot& robot, const std::map<std::string, urdf::JointMimicSharedPtr>& mimics) {
  const auto apply = [&](Joint& joint, const urdf::JointMimic& mimic) {
    if (!std::isfinite(mimic.multiplier) || !std::isfinite(mimic.offset)) {
      refuse_urdf("multiplier and offset of the mimic of " + joint_named(joint.name) + " must be finite");
    }
    joint.mimic_offset += joint.mimic_multiplier * mimic.offset;
    joint.mimic_multiplier *= mimic.multiplier;
    joint.mimic = robot.find_joint(mimic.joint_name);
    if (joint.mimic < 0) {
      refuse_urdf(joint_named(joint.name) + " mimics '" + mimic.joint_name + "', which is no joint of the URDF");
    }
    const Joint& leader = robot.joints[static_cast<std::size_t>(joint.mimic)];
    if (leader.kind == JointKind::fixed) {
      refuse_urdf(joint_named(joint.name) + " mimics '" + leader.name + "', which is fixed: remove the mimic");
    }
  };
  for (Joint& joint : robot.joints) {
    if (joint.kind == JointKind::fixed) continue;
    auto mimic = mimics.find(joint.name);
    for (std::size_t hops = 0; mimic != mimics.end(); ++hops) {
      if (hops > robot.joints.size())
        refuse_urdf(joint_named(joint.name) + " mimics itself in a circle: let one of them move freely");
      apply(joint, *mimic->second);
      mimic = mimics.find(robot.joints[static_cast<std::size_t>(joint.mimic)].name);
    }
  }
}

/// A follower with multiplier 0 stands at its offset, wherever its leader is.
void require_resting_place(const Joint& joint) {
  if (joint.mimic_offset >= joint.lower && joint.mimic_offset <= joint.upper) return;
  std::ostringstream text;
  text << joint_named(joint.name) << " mimics with multiplier 0, so it stands at its offset " << joint.mimic_offset
       << ", outside its limits of " << joint.lower << " to " << joint.upper
       << ": change the offset or the limits, or make it fixed";
  refuse_urdf(text.str());
}

/// A joint may only go where all its followers can go with it. Continuous followers can go anywhere.
void narrow_limits_to_followers(Robot& robot, const urdf::ModelInterface& model) {
  for (const Joint& joint : robot.joints) {
    if (joint.mimic < 0 || model.getJoint(joint.name)->type == urdf::Joint::CONTINUOUS) continue;
    if (joint.mimic_multiplier == 0) {
      require_resting_place(joint);
      continue;
    }
    Joint& leader = robot.joints[static_cast<std::size_t>(joint.mimic)];
    const double a = (joint.lower - joint.mimic_offset) / joint.mimic_multiplier;
    const double b = (joint.upper - joint.mimic_offset) / joint.mimic_multiplier;
    leader.lower = std::max(leader.lower, std::min(a, b));
    leader.upper = std::min(leader.upper, std::max(a, b));
    if (leader.lower >= leader.upper) {
      refuse_urdf("the limits of " + joint_named(joint.name) + " and of '" + leader.name +
                  "', which it mimics, leave no range to move in");
    }
  }
}

Link to_link(const urdf::Link& source, int parent_joint, MeshShelf& meshes) {
  Link link;
  link.name = source.name;
  link.parent_joint = parent_joint;
  for (const auto& collision : source.collision_array) {
    link.shapes.push_back(to_shape(*collision, "link '" + source.name + "'", meshes));
  }
  return link;
}

/// The joints below `link` in the order of their names.
std::vector<const urdf::Joint*> joints_below(const urdf::Link& link) {
  std::vector<const urdf::Joint*> joints;
  for (const auto& joint : link.child_joints) joints.push_back(joint.get());
  std::sort(joints.begin(), joints.end(), [](auto* a, auto* b) { return a->name < b->name; });
  return joints;
}

/// urdfdom's links own their children: a circle of them would never be freed, and a long chain of them is freed
/// recursively.
class LinksLetGo {
 public:
  explicit LinksLetGo(const urdf::ModelInterface& model) : model_(model) {}
  ~LinksLetGo() {
    for (const auto& [name, link] : model_.links_) link->child_links.clear();
  }
  LinksLetGo(const LinksLetGo&) = delete;
  LinksLetGo& operator=(const LinksLetGo&) = delete;

 private:
  const urdf::ModelInterface& model_;
};

/// Links and joints level by level from the root, so that parents come first.
void add_tree(Robot& robot, const urdf::ModelInterface& model, MeshShelf& meshes) {
  std::vector<const urdf::Link*> sources{model.getRoot().get()};
  robot.links.push_back(to_link(*sources[0], -1, meshes));
  for (std::size_t at = 0; at < sources.size(); ++at) {
    for (const urdf::Joint* source : joints_below(*sources[at])) {
      const urdf::Link& child = *model.links_.at(source->child_link_name);
      if (child.parent_joint.get() != source) {
        refuse_urdf("link '" + child.name +
                    "' is the child of more than one joint: a URDF is a tree, give it one parent");
      }
      Joint joint = to_joint(*source);
      joint.parent_link = static_cast<int>(at);
      joint.child_link = static_cast<int>(sources.size());
      robot.joints.push_back(joint);
      robot.links.push_back(to_link(child, static_cast<int>(robot.joints.size()) - 1, meshes));
      sources.push_back(&child);
    }
  }
  for (const auto& [name, link] : model.links_) {
    if (robot.find_link(name) < 0) {
      refuse_urdf("link '" + name + "' is not connected to the root link '" + robot.links[0].name + "'");
    }
  }
}

}  // namespace

int Robot::find_link(const std::string& link) const {
  const auto at = std::find_if(links.begin(), links.end(), [&](const Link& each) { return each.name == link; });
  return at == links.end() ? -1 : static_cast<int>(at - links.begin());
}

int Robot::find_joint(const std::string& joint) const {
  const auto at = std::find_if(joints.begin(), joints.end(), [&](const Joint& each) { return each.name == joint; });
  return at == joints.end() ? -1 : static_cast<int>(at - joints.begin());
}

Robot parse_urdf(const std::string& xml, const std::function<std::string(const std::string& reference)>& read_file) {
  const urdf::ModelInterfaceSharedPtr model = parse_model(xml);
  const LinksLetGo links_let_go(*model);
  if (!model->getRoot()) refuse_urdf("the URDF has no links: give it at least one <link>");
  Robot robot;
  robot.name = model->getName();
  MeshShelf meshes(read_file);
  add_tree(robot, *model, meshes);
  std::map<std::string, urdf::JointMimicSharedPtr> mimics;
  for (const auto& [name, joint] : model->joints_) {
    if (joint->mimic) mimics[name] = joint->mimic;
  }
  resolve_mimics(robot, mimics);
  narrow_limits_to_followers(robot, *model);
  return robot;
}

}  // namespace sculpt
