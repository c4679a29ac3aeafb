#include "core/place/urdf_origin.hpp"

#include <array>
#include <charconv>
#include <optional>
#include <sstream>
#include <string_view>

#include "core/base/error.hpp"

namespace sculpt {
namespace {

/// A tag of the text, from its '<' to behind its '>'.
struct Tag {
  std::size_t begin, end;
};

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/// The next tag from `at` on that is no comment, declaration or CDATA section; nothing if there is none.
std::optional<Tag> next_tag(std::string_view text, std::size_t at) {
  constexpr std::array<std::array<std::string_view, 2>, 3> passed{
      {{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}}};
  while ((at = text.find('<', at)) != std::string_view::npos) {
    bool skipped = false;
    for (const auto& [open, close] : passed) {
      if (text.substr(at, open.size()) != open) continue;
      const std::size_t end = text.find(close, at + open.size());
      if (end == std::string_view::npos) return std::nullopt;
      at = end + close.size();
      skipped = true;
      break;
    }
    if (skipped) continue;
    char quote = 0;
    for (std::size_t end = at; end < text.size(); ++end) {
      const char c = text[end];
      if (quote != 0) {
        if (c == quote) quote = 0;
      } else if (c == '"' || c == '\'') {
        quote = c;
      } else if (c == '>') {
        return Tag{at, end + 1};
      }
    }
    return std::nullopt;
  }
  return std::nullopt;
}

bool is_named(std::string_view text, const Tag& tag, std::string_view name) {
  const std::string_view inside = text.substr(tag.begin + 1, tag.end - tag.begin - 1);
  return inside.starts_with(name) && inside.size() > name.size() &&
         (is_space(inside[name.size()]) || inside[name.size()] == '>' || inside[name.size()] == '/');
}

std::optional<std::string_view> attribute(std::string_view text, const Tag& tag, std::string_view name) {
  const std::string_view inside = text.substr(tag.begin, tag.end - tag.begin);
  for (std::size_t at = inside.find(name); at != std::string_view::npos; at = inside.find(name, at + 1)) {
    if (!is_space(inside[at - 1])) continue;
    std::size_t behind = at + name.size();
    while (behind < inside.size() && is_space(inside[behind])) ++behind;
    if (behind >= inside.size() || inside[behind] != '=') continue;
    ++behind;
    while (behind < inside.size() && is_space(inside[behind])) ++behind;
    const std::size_t end = inside.find(inside[behind], behind + 1);
    if (end != std::string_view::npos) return inside.substr(behind + 1, end - behind - 1);
  }
  return std::nullopt;
}

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

}  // namespace

std::string move_origin(const std::string& urdf, const std::string& joint, const Vec3& at_m, double turn_rad) {
  const std::string_view text = urdf;
  for (auto tag = next_tag(text, 0); tag; tag = next_tag(text, tag->end)) {
    // Transmissions name joints too, without a type.
    if (!is_named(text, *tag, "joint") || !attribute(text, *tag, "type") || attribute(text, *tag, "name") != joint)
      continue;
    for (auto inside = next_tag(text, tag->end); inside; inside = next_tag(text, inside->end)) {
      if (is_named(text, *inside, "/joint"))
        return urdf.substr(0, tag->end) + origin_tag({}, at_m, turn_rad) + "/>" + urdf.substr(tag->end);
      if (!is_named(text, *inside, "origin")) continue;
      const std::string_view end = text[inside->end - 2] == '/' ? "/>" : ">";
      return urdf.substr(0, inside->begin) +
             origin_tag(attribute(text, *inside, "rpy").value_or(std::string_view()), at_m, turn_rad) +
             std::string(end) + urdf.substr(inside->end);
    }
  }
  throw InputError("urdf_invalid", "the text of the URDF has no element of joint '" + joint +
                                       "': write <joint name=\"" + joint + "\" type=...> as plain text");
}

}  // namespace sculpt
