#include "core/place/urdf_origin.hpp"

#include <array>
#include <charconv>
#include <optional>
#include <sstream>
#include <string_view>

#include "core/base/error.hpp"
#include "core/cell/urdf/xml_tags.hpp"

namespace sculpt {
namespace {

std::string number(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value + 0.0).ptr;
  return {text.data(), end};
}

std::string origin_tag(std::string_view rpy_text, const Vec3& at_m, double turn_rad) {
  std::string rpy(rpy_text);
  if (turn_rad != 0) {  // about fixed axes the last one is the parent's z
    double roll = 0, pitch = 0, yaw = 0;
    std::istringstream(rpy.empty() ? "0 0 0" : rpy) >> roll >> pitch >> yaw;
    rpy = number(roll) + " " + number(pitch) + " " + number(yaw + turn_rad);
  }
  return "<origin xyz=\"" + number(at_m.x()) + " " + number(at_m.y()) + " " + number(at_m.z()) + "\"" +
         (rpy.empty() ? "" : " rpy=\"" + rpy + "\"");
}

/// Of its element. Transmissions name joints too, without a type.
std::optional<XmlTag> find_joint(const std::string& urdf, const std::string& joint) {
  for (auto tag = next_tag(urdf, 0); tag; tag = next_tag(urdf, tag->end))
    if (tag->name() == "joint" && tag->attribute("type") && tag->attribute("name") == joint) return tag;
  return std::nullopt;
}

}  // namespace

std::string move_origin(const std::string& urdf, const std::string& joint, const Vec3& at_m, double turn_rad) {
  const auto element = find_joint(urdf, joint);
  for (auto tag = element; tag; tag = next_tag(urdf, tag->end)) {
    if (tag->closes() && tag->name() == "joint")
      return urdf.substr(0, element->end) + origin_tag({}, at_m, turn_rad) + "/>" + urdf.substr(element->end);
    if (tag->closes() || tag->name() != "origin") continue;
    return urdf.substr(0, tag->begin) + origin_tag(tag->attribute("rpy").value_or(""), at_m, turn_rad) +
           (tag->is_empty() ? "/>" : ">") + urdf.substr(tag->end);
  }
  throw InputError("urdf_invalid", "the text of the URDF has no element of joint '" + joint +
                                       "': write <joint name=\"" + joint + "\" type=...> as plain text");
}

}  // namespace sculpt
