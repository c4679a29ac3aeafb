#include "core/verify/robot/urdf_differences.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <sstream>

#include "core/base/error.hpp"

namespace sculpt {
namespace {

constexpr double urdf_slack = 1e-9;

std::string text_of(double value) {
  std::ostringstream out;
  out.precision(10);
  out << value;
  return out.str();
}

std::string text_of(const Vec3& v) {
  return text_of(v.x()) + " " + text_of(v.y()) + " " + text_of(v.z());
}

// Place, and the rows of the turn.
std::string text_of(const Frame& frame) {
  const Eigen::Matrix3d turn = frame.linear();
  return "xyz " + text_of(Vec3(frame.translation())) + ", turned to " + text_of(Vec3(turn.row(0))) + " / " +
         text_of(Vec3(turn.row(1))) + " / " + text_of(Vec3(turn.row(2)));
}

const std::string& text_of(const std::string& text) {
  return text;
}

bool same(double a, double b) {
  return std::abs(a - b) <= urdf_slack * std::max({1.0, std::abs(a), std::abs(b)});
}
bool same(const Vec3& a, const Vec3& b) {
  return same(a.x(), b.x()) && same(a.y(), b.y()) && same(a.z(), b.z());
}
bool same(const Frame& a, const Frame& b) {
  return same(Vec3(a.translation()), Vec3(b.translation())) &&
         (a.linear() - b.linear()).cwiseAbs().maxCoeff() <= urdf_slack;
}
bool same(const std::string& a, const std::string& b) {
  return a == b;
}

const char* name_of(JointKind kind) {
  switch (kind) {
    case JointKind::fixed:
      return "fixed";
    case JointKind::revolute:
      return "revolute";
    case JointKind::prismatic:
      break;
  }
  return "prismatic";
}

const char* name_of(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::sphere:
      return "sphere";
    case ShapeKind::box:
      return "box";
    case ShapeKind::cylinder:
      return "cylinder";
    case ShapeKind::mesh:
      break;
  }
  return "mesh";
}

// value = multiplier * (value of the joint `leader`) + offset; a joint that follows none leads itself.
struct Follow {
  std::string leader;
  double multiplier = 1, offset = 0;
};

Follow follow(const UrdfText& text, const std::string& name) {
  Follow way{name};
  for (std::size_t hops = 0; hops <= text.joints.size(); ++hops) {
    const auto at = text.joints.find(way.leader);
    if (at == text.joints.end() || at->second.mimic.empty() || at->second.type == "fixed") break;
    way = {at->second.mimic, way.multiplier * at->second.multiplier, way.multiplier * at->second.offset + way.offset};
  }
  return way;
}

struct JointBounds {
  double lower = 0, upper = 0;
};

// Of every joint: a leader goes no farther than its followers can.
std::map<std::string, JointBounds> all_limits(const UrdfText& text) {
  constexpr double turn = 2 * std::numbers::pi;
  std::map<std::string, JointBounds> limits;
  for (const auto& [name, joint] : text.joints)
    limits[name] = joint.type == "continuous" ? JointBounds{-turn, turn} : JointBounds{joint.lower, joint.upper};
  for (const auto& [name, joint] : text.joints) {
    const Follow way = follow(text, name);
    const auto leader = limits.find(way.leader);
    if (way.leader == name || way.multiplier == 0 || joint.type == "continuous" || leader == limits.end()) continue;
    const double a = (joint.lower - way.offset) / way.multiplier, b = (joint.upper - way.offset) / way.multiplier;
    JointBounds& narrowed = leader->second;
    narrowed = {std::max(narrowed.lower, std::min(a, b)), std::min(narrowed.upper, std::max(a, b))};
  }
  return limits;
}

// The largest radius of a holder between two distances from the spindle, m.
double holder_radius(const std::vector<HolderSection>& holder, double from_m, double to_m) {
  double start_m = 0, radius_m = 0;
  for (const HolderSection& section : holder) {
    const double low = std::max(from_m, start_m), high = std::min(to_m, start_m + section.length_m);
    const auto radius_at = [&](double z_m) {
      return section.radius_m + (section.end_radius_m - section.radius_m) * (z_m - start_m) / section.length_m;
    };
    if (low < high) radius_m = std::max({radius_m, radius_at(low), radius_at(high)});
    start_m += section.length_m;
  }
  return radius_m;
}

class Differences {
 public:
  Differences(const UrdfText& text, const Cell& cell)
      : text_(text), cell_(cell), robot_(cell.robot), limits_(all_limits(text)) {}

  std::vector<std::string> find() {
    for (const auto& [name, joint] : text_.joints)
      if (robot_.find_joint(name) < 0)
        sentences_.push_back("joint '" + name + "' of the URDF is not in the loaded cell");
    for (const auto& [name, shapes] : text_.links)
      if (robot_.find_link(name) < 0) sentences_.push_back("link '" + name + "' of the URDF is not in the loaded cell");
    for (const Joint& joint : robot_.joints) compare(joint);
    for (std::size_t link = 0; link < robot_.links.size(); ++link) compare(static_cast<int>(link));
    return std::move(sentences_);
  }

 private:
  template <typename Value>
  void compare(const std::string& of, const std::string& what, const Value& said, const Value& loaded) {
    if (!same(said, loaded))
      sentences_.push_back(of + ": the URDF says " + what + " " + text_of(said) + ", the loaded cell has " +
                           text_of(loaded));
  }

  const std::string& name_of_link(int link) const { return robot_.links[static_cast<std::size_t>(link)].name; }

  void compare(const Joint& joint) {
    const std::string of = "joint '" + joint.name + "'";
    const auto at = text_.joints.find(joint.name);
    if (at == text_.joints.end()) return sentences_.push_back(of + " of the loaded cell is not in the URDF");
    const TextJoint& said = at->second;
    compare<std::string>(of, "type", said.type == "continuous" ? "revolute" : said.type, name_of(joint.kind));
    compare<std::string>(of, "parent", said.parent, name_of_link(joint.parent_link));
    compare<std::string>(of, "child", said.child, name_of_link(joint.child_link));
    compare<Frame>(of, "origin", said.origin, joint.origin);
    if (said.type == "fixed") return;
    compare<Vec3>(of, "axis", said.axis.normalized(), joint.axis);
    const JointBounds& limits = limits_.at(joint.name);
    compare(of, "lower limit", limits.lower, joint.lower);
    compare(of, "upper limit", limits.upper, joint.upper);
    const Follow way = follow(text_, joint.name);
    const Joint& leader = joint.mimic < 0 ? joint : robot_.joints[static_cast<std::size_t>(joint.mimic)];
    compare<std::string>(of, "it follows", way.leader, leader.name);
    compare(of, "multiplier", way.multiplier, joint.mimic_multiplier);
    compare(of, "offset", way.offset, joint.mimic_offset);
  }

  void compare(int index) {
    const Link& link = robot_.links[static_cast<std::size_t>(index)];
    const std::string of = "link '" + link.name + "'";
    const auto at = text_.links.find(link.name);
    if (at == text_.links.end()) return sentences_.push_back(of + " of the loaded cell is not in the URDF");
    const std::size_t said = at->second.size(), post = index == cell_.stock_link && cell_.has_post ? 1 : 0;
    const bool has_holder = index == cell_.tool_link && !cell_.tool.holder.empty();
    if (has_holder ? link.shapes.size() < said + post : link.shapes.size() != said + post)
      return sentences_.push_back(of + ": the URDF says " + std::to_string(said) +
                                  " collision shapes, the loaded cell has " +
                                  std::to_string(std::max(link.shapes.size(), post) - post));
    if (has_holder) compare_holder(of, std::span(link.shapes).subspan(said, link.shapes.size() - said - post));
    for (std::size_t shape = 0; shape < at->second.size(); ++shape)
      compare("shape " + std::to_string(shape + 1) + " of " + of, at->second[shape], link.shapes[shape]);
  }

  // One cylinder stands on the other, from the spindle on, and the holder does not come out of any of them.
  void compare_holder(const std::string& of, std::span<const Shape> bodies) {
    double length_m = 0, held_m = 0;
    for (const HolderSection& section : cell_.tool.holder) length_m += section.length_m;
    for (const Shape& body : bodies) {
      const double end_m = held_m + body.length_m;
      Frame place = Frame::Identity();
      place.translation().z() = (held_m + end_m) / 2;
      if (body.kind != ShapeKind::cylinder || !same(place, body.pose) ||
          body.radius_m + urdf_slack < holder_radius(cell_.tool.holder, held_m + urdf_slack, end_m - urdf_slack))
        break;
      held_m = end_m;
    }
    if (!same(length_m, held_m))
      sentences_.push_back(of + ": the holder is " + text_of(length_m) + " m long, its bodies hold it to " +
                           text_of(held_m) + " m from the spindle");
  }

  void compare(const std::string& of, const TextShape& said, const Shape& shape) {
    if (said.kind != shape.kind) return compare<std::string>(of, "it is a", name_of(said.kind), name_of(shape.kind));
    compare<Frame>(of, "origin", said.pose, shape.pose);
    switch (said.kind) {
      case ShapeKind::sphere:
        return compare(of, "radius", said.size.x(), shape.radius_m);
      case ShapeKind::box:
        return compare<Vec3>(of, "size", said.size, shape.sides_m);
      case ShapeKind::cylinder:
        compare(of, "radius", said.size.x(), shape.radius_m);
        return compare(of, "length", said.size.y(), shape.length_m);
      case ShapeKind::mesh:
        compare<std::string>(of, "file", said.file, shape.mesh_file);
        return compare<Vec3>(of, "scale", said.size, shape.mesh_scale);
    }
  }

  const UrdfText& text_;
  const Cell& cell_;
  const Robot& robot_;
  const std::map<std::string, JointBounds> limits_;
  std::vector<std::string> sentences_;
};

}  // namespace

std::vector<std::string> urdf_differences(const UrdfText& text, const Cell& cell) {
  return Differences(text, cell).find();
}

std::vector<std::string> urdf_differences(const Cell& cell) {
  if (cell.urdf.empty()) return {};
  try {
    return urdf_differences(read_urdf_text(cell.urdf), cell);
  } catch (const InputError& error) {
    return {std::string("the replay cannot read the cell's URDF: ") + error.what()};
  }
}

}  // namespace sculpt
