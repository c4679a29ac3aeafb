#include "core/trajectory/milling/mill_line.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>

#include "core/trajectory/quantum.hpp"
#include "core/trajectory/text/line_fields.hpp"
#include "core/trajectory/text/number_text.hpp"
#include "core/trajectory/text/write_text.hpp"

namespace sculpt {
namespace {

using Json = LineFields::Json;

constexpr std::size_t max_header_tools = 16, max_directions = 256, max_sections = 32, max_removed_digits = 10;
constexpr int max_component = 1000;

std::string json_text(const std::string& text) {
  return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

void append_field(std::string& text, const char* name, double value) {
  text += std::string(",\"") + name + "\":";
  append_number(text, value);
}

void append_tool(std::string& text, const MillTool& tool) {
  text += R"({"name":)" + json_text(tool.name) + R"(,"number":)" + std::to_string(tool.number) +
          R"(,"cutter":{"kind":")" + name(tool.cutter.kind) + '"';
  append_field(text, "diameter_m", 2 * tool.cutter.radius_m);
  if (tool.cutter.kind == CutterKind::bull) append_field(text, "corner_radius_m", tool.cutter.corner_radius_m);
  append_field(text, "flute_m", tool.cutter.flute_m);
  text += R"(},"body":[)";
  for (const HolderSection& section : tool.body) {
    if (text.back() != '[') text += ',';
    text += R"({"length_m":)";
    append_number(text, section.length_m);
    append_field(text, "radius_m", section.radius_m);
    append_field(text, "end_radius_m", section.end_radius_m);
    text += '}';
  }
  text += ']';
  append_field(text, "stickout_m", tool.stickout_m);
  append_field(text, "max_depth_m", tool.max_depth_m);
  append_field(text, "max_width_m", tool.max_width_m);
  append_field(text, "feed_m_s", tool.feed_m_s);
  if (tool.plunge_m_s) append_field(text, "plunge_m_s", *tool.plunge_m_s);
  if (tool.spindle_rpm) append_field(text, "spindle_rpm", *tool.spindle_rpm);
  text += '}';
}

Cutter parse_cutter(const LineFields& fields) {
  Cutter cutter;
  const std::string kind = fields.text("kind");
  const auto kinds = {CutterKind::ball, CutterKind::bull, CutterKind::flat};
  const auto found = std::ranges::find_if(kinds, [&](CutterKind each) { return kind == name(each); });
  if (found == kinds.end()) refuse_line(fields.where(), "cutter kind '" + kind + "' is not ball, bull or flat");
  cutter.kind = *found;
  cutter.radius_m = fields.number("diameter_m", std::numeric_limits<double>::min()) / 2;
  cutter.flute_m = fields.number("flute_m", 0);
  if (cutter.kind == CutterKind::ball) cutter.corner_radius_m = cutter.radius_m;
  if (cutter.kind == CutterKind::bull) cutter.corner_radius_m = fields.number("corner_radius_m", 0);
  if (cutter.corner_radius_m > cutter.radius_m)
    refuse_line(fields.where(), "a corner radius is more than its cutter's");
  return cutter;
}

MillTool parse_tool(const LineFields& fields) {
  MillTool tool;
  tool.name = fields.text("name");
  tool.number = static_cast<int>(std::min<std::uint64_t>(fields.count("number"), 1'000'000));
  tool.cutter = parse_cutter(fields.object("cutter"));
  for (const Json& json : fields.array("body", 1, max_sections)) {
    const LineFields section(json, fields.where());
    tool.body.push_back(
        {section.number("length_m", 0), section.number("radius_m", 0), section.number("end_radius_m", 0)});
  }
  tool.stickout_m = fields.number("stickout_m", 0);
  tool.max_depth_m = fields.number("max_depth_m", 0);
  tool.max_width_m = fields.number("max_width_m", 0);
  tool.feed_m_s = fields.number("feed_m_s", 0);
  if (fields.has("plunge_m_s")) tool.plunge_m_s = fields.number("plunge_m_s", 0);
  if (fields.has("spindle_rpm")) tool.spindle_rpm = fields.number("spindle_rpm", 0);
  return tool;
}

std::array<int, 3> parse_direction(const Json& json, const std::string& where) {
  std::array<int, 3> direction{};
  if (!json.is_array() || json.size() != 3) refuse_line(where, "a direction is not a list of 3 whole numbers");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!json[axis].is_number_integer() || json[axis].get<double>() > max_component ||
        json[axis].get<double>() < -max_component)
      refuse_line(where, "a direction's component is not a whole number from -1000 to 1000");
    direction[axis] = json[axis].get<int>();
  }
  if (direction == std::array<int, 3>{}) refuse_line(where, "a direction is 0, 0, 0");
  return direction;
}

}  // namespace

void append_mill_header(std::string& text, const MillHeader& header) {
  text += R"(,"tools":[)";
  for (const MillTool& tool : header.tools) {
    if (text.back() != '[') text += ',';
    append_tool(text, tool);
  }
  text += R"(],"directions":[)";
  for (const auto& direction : header.directions) {
    if (text.back() != '[') text += ',';
    append_numbers(text, direction);
  }
  text += ']';
  append_field(text, "stray_m", header.stray_m);
  text += R"(,"mesh_sha256":)" + json_text(header.mesh_sha256);
}

MillHeader parse_mill_header(const LineFields& fields) {
  MillHeader header;
  for (const Json& json : fields.array("tools", 1, max_header_tools)) {
    if (!json.is_object()) refuse_line(fields.where(), "a tool is not an object");
    header.tools.push_back(parse_tool({json, fields.where()}));
  }
  for (const Json& json : fields.array("directions", 1, max_directions))
    header.directions.push_back(parse_direction(json, fields.where()));
  header.stray_m = fields.number("stray_m", 0);
  header.mesh_sha256 = fields.text("mesh_sha256");
  return header;
}

std::size_t max_mill_line_bytes(const MillHeader& header) {
  std::size_t longest = 0;
  for (const MillTool& tool : header.tools) longest = std::max(longest, json_text(tool.name).size());
  return longest + 3 * (max_number_bytes + 1) + max_removed_digits + 64;
}

char* write_mill_line(char* out, const Keyframe& keyframe, const MillHeader& header) {
  const MillStep& step = *keyframe.mill;
  if (step.is_change()) {
    out = write_text(out, R"({"type":"tool","tool":)");
    out = write_text(out, json_text(header.tools.at(static_cast<std::size_t>(step.tool)).name));
    out = write_text(out, R"(,"q":[)");
  } else {
    out = write_text(out, keyframe.cut ? R"({"type":"cut","q":[)" : R"({"type":"move","q":[)");
  }
  for (Eigen::Index at = 0; at < keyframe.q.size(); ++at) {
    if (at > 0) *out++ = ',';
    out = write_number(out, keyframe.q[at]);
  }
  if (!step.is_placed()) return write_text(out, "]}\n");
  out = write_text(out, R"(],"direction":)");
  out = std::to_chars(out, out + max_number_bytes, step.direction).ptr;
  out = write_text(out, R"(,"tip":[)");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (axis > 0) *out++ = ',';
    out = write_number(out, from_quanta(step.tip[axis]));
  }
  if (!keyframe.cut) return write_text(out, "]}\n");
  out = write_text(out, R"(],"removed":)");
  out = std::to_chars(out, out + max_number_bytes, step.removed).ptr;
  return write_text(out, "}\n");
}

Keyframe parse_mill_line(const LineFields& fields, const std::string& type, const TrajectoryHeader& header) {
  const MillHeader& mill = *header.mill;
  const std::string& where = fields.where();
  if (type != "move" && type != "cut" && type != "tool")
    refuse_line(where, "field \"type\" is not move, cut, tool or end");
  Keyframe keyframe;
  keyframe.q = fields.numbers("q", header.joints.size());
  keyframe.cut = type == "cut";
  MillStep& step = keyframe.mill.emplace();
  if (type == "tool") {
    const auto found = std::ranges::find(mill.tools, fields.text("tool"), &MillTool::name);
    if (found == mill.tools.end()) refuse_line(where, "tool '" + fields.text("tool") + "' is not one of the header's");
    step.tool = static_cast<int>(found - mill.tools.begin());
    return keyframe;
  }
  if (!keyframe.cut && !fields.has("tip")) return keyframe;
  const std::uint64_t direction = fields.count("direction");
  if (direction >= mill.directions.size())
    refuse_line(where, "direction " + std::to_string(direction) + " is not one of the header's");
  step.direction = static_cast<int>(direction);
  const Configuration tip = fields.numbers("tip", 3);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const auto quanta = to_quanta(tip[axis]);
    if (!quanta || std::abs(tip[axis]) > max_tip_m)
      refuse_line(where, "field \"tip\" holds a value that is no multiple of 1e-7 m, or is out of range");
    step.tip[static_cast<std::size_t>(axis)] = *quanta;
  }
  if (!keyframe.cut) return keyframe;
  const std::uint64_t removed = fields.count("removed"), n = static_cast<std::uint64_t>(header.grid.n);
  if (removed > n * n * n) refuse_line(where, "field \"removed\" is more than there are voxels");
  step.removed = static_cast<std::uint32_t>(removed);
  return keyframe;
}

}  // namespace sculpt
