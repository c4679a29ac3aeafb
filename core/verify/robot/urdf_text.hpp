// The text of a URDF -> joints and shapes, by a reader that has nothing in common with the one of the cell's loader.
// Internal to verify/. Metres and radians, as the text says them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/cell/robot.hpp"

namespace sculpt {

/// A collision shape.
struct TextShape {
  ShapeKind kind = ShapeKind::box;
  Frame pose = Frame::Identity();
  Vec3 size = Vec3::Zero();  ///< box: sides; sphere: radius, 0, 0; cylinder: radius, length, 0; mesh: scale
  std::string file;          ///< mesh
};

struct TextJoint {
  std::string type, parent, child;
  Frame origin = Frame::Identity();
  Vec3 axis = Vec3::UnitX();
  double lower = 0, upper = 0;
  std::string mimic;  ///< the joint that this one follows; empty: none
  double multiplier = 1, offset = 0;
};

struct UrdfText {
  std::map<std::string, std::vector<TextShape>> links;
  std::map<std::string, TextJoint> joints;
};

/// Throws InputError `urdf_invalid` where something is missing or no number.
UrdfText read_urdf_text(const std::string& xml);

}  // namespace sculpt
