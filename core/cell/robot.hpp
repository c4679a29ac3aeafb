// A URDF as plain values. The only door to urdfdom is robot.cpp.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/base/frame.hpp"
#include "core/mesh/mesh.hpp"

namespace sculpt {

enum class ShapeKind { sphere, box, cylinder, mesh };

/// One collision shape of a link. Cylinders stand along z. Metres, in the link's frame.
struct Shape {
  ShapeKind kind = ShapeKind::box;
  Frame pose = Frame::Identity();
  Vec3 sides_m = Vec3::Zero();       ///< box: full sides
  double radius_m = 0;               ///< sphere, cylinder
  double length_m = 0;               ///< cylinder
  std::shared_ptr<const Mesh> mesh;  ///< mesh: in metres (URDF scale applied)
  std::string mesh_file;             ///< mesh: its reference as the URDF writes it
  Vec3 mesh_scale = Vec3::Ones();    ///< mesh: the URDF's scale, applied already
};

struct Link {
  std::string name;
  std::vector<Shape> shapes;
  int parent_joint = -1;  ///< -1 for the root
};

enum class JointKind { fixed, revolute, prismatic };

/// Child frame = parent frame * origin * (turn by q about `axis` | shift by q along `axis`). Continuous joints are
/// revolute with limits of -2 pi and 2 pi.
struct Joint {
  std::string name;
  JointKind kind = JointKind::fixed;
  int parent_link = -1;
  int child_link = -1;
  Frame origin = Frame::Identity();
  Vec3 axis = Vec3::UnitZ();
  double lower = 0, upper = 0;  ///< rad or m
  double max_speed = 0;         ///< rad/s or m/s; 0 = not given
  int mimic = -1;               ///< joint that this one follows: q = multiplier * q_mimic + offset
  double mimic_multiplier = 1, mimic_offset = 0;
};

/// A tree of links; joints are ordered so that a parent link's own joint comes before the joints below it.
struct Robot {
  std::string name;
  std::vector<Link> links;
  std::vector<Joint> joints;
  int root = 0;

  /// Index by name, or -1.
  int find_link(const std::string& link) const;
  int find_joint(const std::string& joint) const;
};

/// `read_file` returns the bytes behind a mesh reference exactly as the URDF writes it (package:// or relative); it
/// throws InputError where it cannot. Throws InputError `urdf_invalid` (malformed, no links, floating or planar joints,
/// a mimic that names nothing, non-positive sizes).
Robot parse_urdf(const std::string& xml, const std::function<std::string(const std::string& reference)>& read_file);

}  // namespace sculpt
