#include "core/verify/robot/urdf_text.hpp"

#include <tinyxml2.h>

#include <charconv>
#include <string_view>

#include "core/base/error.hpp"

namespace sculpt {
namespace {

using tinyxml2::XMLElement;

[[noreturn]] void refuse(const XMLElement& element, const std::string& what) {
  throw InputError("urdf_invalid", "<" + std::string(element.Name()) + "> in line " +
                                       std::to_string(element.GetLineNum()) + " " + what);
}

std::string attribute(const XMLElement& element, const char* name) {
  const char* text = element.Attribute(name);
  if (text == nullptr) refuse(element, "has no " + std::string(name));
  return text;
}

const XMLElement& child(const XMLElement& element, const char* name) {
  const XMLElement* found = element.FirstChildElement(name);
  if (found == nullptr) refuse(element, "has no <" + std::string(name) + ">");
  return *found;
}

// As many numbers as `count`, with white space between them.
std::vector<double> read_numbers(const XMLElement& element, const char* name, std::size_t count) {
  const std::string text = attribute(element, name);
  constexpr std::string_view blank = " \t\r\n";
  std::vector<double> numbers;
  for (std::size_t at = text.find_first_not_of(blank); at != std::string::npos;) {
    const std::size_t end = std::min(text.find_first_of(blank, at), text.size());
    const std::size_t digits = text[at] == '+' ? at + 1 : at;
    double number = 0;
    const auto [rest, error] = std::from_chars(text.data() + digits, text.data() + end, number);
    if (error != std::errc{} || rest != text.data() + end)
      refuse(element, std::string(name) + "=\"" + text + "\": no number");
    numbers.push_back(number);
    at = text.find_first_not_of(blank, end);
  }
  if (numbers.size() != count)
    refuse(element, std::string(name) + "=\"" + text + "\" should be " + std::to_string(count) + " numbers");
  return numbers;
}

double read_number(const XMLElement& element, const char* name) {
  return read_numbers(element, name, 1).front();
}

double read_number(const XMLElement& element, const char* name, double otherwise) {
  return element.Attribute(name) == nullptr ? otherwise : read_number(element, name);
}

Vec3 read_vector(const XMLElement& element, const char* name) {
  return Vec3(read_numbers(element, name, 3).data());
}

// First about x, then about the y and the z that stood still meanwhile.
Eigen::Matrix3d turn(const Vec3& rpy) {
  const double cr = std::cos(rpy.x()), sr = std::sin(rpy.x()), cp = std::cos(rpy.y()), sp = std::sin(rpy.y()),
               cy = std::cos(rpy.z()), sy = std::sin(rpy.z());
  Eigen::Matrix3d matrix;
  matrix << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,  //
      sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,        //
      -sp, cp * sr, cp * cr;
  return matrix;
}

Frame read_origin(const XMLElement& owner) {
  Frame frame = Frame::Identity();
  const XMLElement* origin = owner.FirstChildElement("origin");
  if (origin == nullptr) return frame;
  if (origin->Attribute("xyz") != nullptr) frame.translation() = read_vector(*origin, "xyz");
  if (origin->Attribute("rpy") != nullptr) frame.linear() = turn(read_vector(*origin, "rpy"));
  return frame;
}

TextShape read_shape(const XMLElement& collision) {
  TextShape shape;
  shape.pose = read_origin(collision);
  const XMLElement* geometry = child(collision, "geometry").FirstChildElement();
  if (geometry == nullptr) refuse(collision, "has no shape");
  const std::string_view kind = geometry->Name();
  if (kind == "box") {
    shape.size = read_vector(*geometry, "size");
  } else if (kind == "sphere") {
    shape.kind = ShapeKind::sphere;
    shape.size.x() = read_number(*geometry, "radius");
  } else if (kind == "cylinder") {
    shape.kind = ShapeKind::cylinder;
    shape.size = {read_number(*geometry, "radius"), read_number(*geometry, "length"), 0};
  } else if (kind == "mesh") {
    shape.kind = ShapeKind::mesh;
    shape.file = attribute(*geometry, "filename");
    shape.size = geometry->Attribute("scale") == nullptr ? Vec3::Ones() : read_vector(*geometry, "scale");
  } else {
    refuse(*geometry, "is no shape");
  }
  return shape;
}

TextJoint read_joint(const XMLElement& element) {
  TextJoint joint;
  joint.type = attribute(element, "type");
  joint.parent = attribute(child(element, "parent"), "link");
  joint.child = attribute(child(element, "child"), "link");
  joint.origin = read_origin(element);
  if (const XMLElement* axis = element.FirstChildElement("axis")) joint.axis = read_vector(*axis, "xyz");
  if (const XMLElement* limit = element.FirstChildElement("limit")) {
    joint.lower = read_number(*limit, "lower", 0);
    joint.upper = read_number(*limit, "upper", 0);
  }
  if (const XMLElement* mimic = element.FirstChildElement("mimic")) {
    joint.mimic = attribute(*mimic, "joint");
    joint.multiplier = read_number(*mimic, "multiplier", 1);
    joint.offset = read_number(*mimic, "offset", 0);
  }
  return joint;
}

}  // namespace

UrdfText read_urdf_text(const std::string& xml) {
  tinyxml2::XMLDocument document;
  if (document.Parse(xml.data(), xml.size()) != tinyxml2::XML_SUCCESS)
    throw InputError("urdf_invalid", std::string("it is no XML: ") + document.ErrorStr());
  const XMLElement* robot = document.FirstChildElement("robot");
  if (robot == nullptr) throw InputError("urdf_invalid", "it has no <robot>");
  UrdfText text;
  for (const XMLElement* link = robot->FirstChildElement("link"); link; link = link->NextSiblingElement("link")) {
    const auto [shapes, is_new] = text.links.try_emplace(attribute(*link, "name"));
    if (!is_new) refuse(*link, "has a name that another one has");
    for (const XMLElement* each = link->FirstChildElement("collision"); each;
         each = each->NextSiblingElement("collision"))
      shapes->second.push_back(read_shape(*each));
  }
  for (const XMLElement* joint = robot->FirstChildElement("joint"); joint; joint = joint->NextSiblingElement("joint"))
    if (!text.joints.try_emplace(attribute(*joint, "name"), read_joint(*joint)).second)
      refuse(*joint, "has a name that another one has");
  return text;
}

}  // namespace sculpt
