#include "core/trajectory/text/trajectory_line.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <set>
#include <stdexcept>

#include "core/material/resolution.hpp"
#include "core/trajectory/milling/mill_line.hpp"
#include "core/trajectory/text/line_fields.hpp"
#include "core/trajectory/text/number_text.hpp"
#include "core/trajectory/text/write_text.hpp"

namespace sculpt {
namespace {

using Json = LineFields::Json;

constexpr int max_nesting = 8;

char* write_voxel(char* out, Voxel voxel) {
  for (auto [before, value] : {std::pair{'[', voxel.i}, {',', voxel.j}, {',', voxel.k}}) {
    *out++ = before;
    out = std::to_chars(out, out + max_number_bytes, value).ptr;
  }
  *out++ = ']';
  return out;
}

// Text that is not UTF-8 is written with replacement characters instead of failing half-way.
std::string json_text(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// Brackets outside strings: refused before parsing, so that no parser or destructor is asked to go deep.
bool nested_too_deep(std::string_view text) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (quoted && c == '\\') {
      ++at;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && (c == '[' || c == '{')) {
      if (++depth > max_nesting) return true;
    } else if (!quoted && (c == ']' || c == '}')) {
      --depth;
    }
  }
  return false;
}

Json parse_object(std::string_view text, const std::string& where) {
  if (nested_too_deep(text))
    refuse_line(where, "brackets are nested more than " + std::to_string(max_nesting) + " deep");
  try {
    Json value = Json::parse(text.begin(), text.end());
    if (!value.is_object()) refuse_line(where, "not a JSON object");
    return value;
  } catch (const Json::exception&) {
    refuse_line(where, "not JSON");
  }
}

Voxel parse_voxel(const Json& value, const std::string& where) {
  std::array<int, 3> at{};
  if (!value.is_array() || value.size() != 3) refuse_line(where, "a voxel is not a list of 3 whole numbers");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!value[axis].is_number_unsigned() || value[axis].get<std::uint64_t>() >= max_resolution)
      refuse_line(where, "a voxel index is not a whole number from 0 to " + std::to_string(max_resolution - 1));
    at[axis] = value[axis].get<int>();
  }
  return {at[0], at[1], at[2]};
}

}  // namespace

std::string header_line(const TrajectoryHeader& header) {
  std::string text = R"({"type":"header","format":)" + std::to_string(header.mill ? 2 : 1) + R"(,"joints":)" +
                     json_text(header.joints) + R"(,"home":)";
  append_numbers(text, header.home);
  text += R"(,"resolution":)" + std::to_string(header.grid.n) + R"(,"voxel_m":)";
  append_number(text, header.grid.voxel_m);
  text += R"(,"origin_m":)";
  append_numbers(text, header.grid.origin_m);
  if (header.mill) {
    append_mill_header(text, *header.mill);
  } else {
    text += R"(,"tool":{"ball_radius_m":)";
    append_number(text, header.tool.ball_radius_m);
    text += R"(,"shank_radius_m":)";
    append_number(text, header.tool.shank_radius_m);
    text += R"(,"stickout_m":)";
    append_number(text, header.tool.stickout_m);
    text += '}';
  }
  text += R"(,"tolerance_m":)";
  append_number(text, header.tolerance_m);
  text += R"(,"cell":)" + json_text(header.cell) + R"(,"search":)" + json_text(header.search);
  return text + R"(,"seed":)" + std::to_string(header.seed) + (header.held ? R"(,"held":true})" : "}");
}

std::size_t max_keyframe_line_bytes(const TrajectoryHeader& header) {
  return 128 + header.joints.size() * (max_number_bytes + 1) + (header.mill ? max_mill_line_bytes(*header.mill) : 0);
}

char* write_keyframe_line(char* out, const Keyframe& keyframe, const TrajectoryHeader& header) {
  if (keyframe.mill) return write_mill_line(out, keyframe, header.mill.value());
  out = write_text(out, keyframe.cut ? R"({"type":"cut","q":[)" : R"({"type":"move","q":[)");
  for (Eigen::Index at = 0; at < keyframe.q.size(); ++at) {
    if (at > 0) *out++ = ',';
    out = write_number(out, keyframe.q[at]);
  }
  if (!keyframe.cut) return write_text(out, "]}\n");
  out = write_text(out, R"(],"voxels":[)");
  out = write_voxel(out, keyframe.first);
  *out++ = ',';
  out = write_voxel(out, keyframe.last);
  return write_text(out, "]}\n");
}

std::string end_line(const TrajectoryEnd& end) {
  return R"({"type":"end","keyframes":)" + std::to_string(end.keyframes) + R"(,"removed":)" +
         std::to_string(end.removed) + R"(,"sha256":")" + end.sha256 + "\"}";
}

TrajectoryHeader parse_header_line(std::string_view text, const std::string& where) {
  const Json object = parse_object(text, where);
  const LineFields fields(object, where);
  if (fields.text("type") != "header") refuse_line(where, "the first line is not a header");
  const std::uint64_t format = fields.count("format");
  if (format != 1 && format != 2)
    refuse_line(where, "format " + std::to_string(format) + " is not known, only 1 and 2");
  TrajectoryHeader header;
  std::set<std::string> seen;
  for (const Json& joint : fields.array("joints", 1, max_joints)) {
    if (!joint.is_string() || !seen.insert(joint.get<std::string>()).second)
      refuse_line(where, "field \"joints\" is not a list of different names");
    header.joints.push_back(joint.get<std::string>());
  }
  header.home = fields.numbers("home", header.joints.size());
  const std::uint64_t resolution = fields.count("resolution");
  if (resolution < 1 || resolution > max_resolution)
    refuse_line(where,
                "resolution " + std::to_string(resolution) + " is not in 1 to " + std::to_string(max_resolution));
  header.grid.n = static_cast<int>(resolution);
  header.grid.voxel_m = fields.number("voxel_m", std::numeric_limits<double>::min());
  header.grid.origin_m = fields.numbers("origin_m", 3);
  if (format == 2) {
    header.mill = parse_mill_header(fields);
  } else {
    const LineFields tool = fields.object("tool");
    header.tool = {tool.number("ball_radius_m", 0), tool.number("shank_radius_m", 0), tool.number("stickout_m", 0)};
  }
  header.tolerance_m = fields.number("tolerance_m", 0);
  header.cell = fields.text("cell");
  header.search = fields.text("search");
  header.seed = fields.count("seed");
  header.held = fields.flag("held");
  return header;
}

bool is_run(const Keyframe& keyframe, const Grid& grid) {
  const Voxel run = keyframe.last - keyframe.first;
  return grid.contains(keyframe.first) && grid.contains(keyframe.last) &&
         (run.i != 0) + (run.j != 0) + (run.k != 0) <= 1;
}

void check_run(const Keyframe& keyframe, const Grid& grid, const std::string& where) {
  if (is_run(keyframe, grid)) return;
  if (grid.contains(keyframe.first) && grid.contains(keyframe.last))
    refuse_line(where, "the voxels of a cut do not lie along one axis");
  refuse_line(where, "a voxel is outside the grid of " + std::to_string(grid.n));
}

TrajectoryLine parse_line(std::string_view text, const TrajectoryHeader& header, const std::string& where) {
  const Json object = parse_object(text, where);
  const LineFields fields(object, where);
  const std::string type = fields.text("type");
  TrajectoryLine line;
  if (type == "end") {
    line.is_end = true;
    line.end = {fields.count("keyframes"), fields.count("removed"), fields.text("sha256")};
    return line;
  }
  if (header.mill) {
    line.keyframe = parse_mill_line(fields, type, header);
    return line;
  }
  if (type != "move" && type != "cut") refuse_line(where, "field \"type\" is not move, cut or end");
  line.keyframe.q = fields.numbers("q", header.joints.size());
  line.keyframe.cut = type == "cut";
  if (line.keyframe.cut) {
    const Json& run = fields.array("voxels", 2, 2);
    line.keyframe.first = parse_voxel(run[0], where);
    line.keyframe.last = parse_voxel(run[1], where);
    check_run(line.keyframe, header.grid, where);
  }
  return line;
}

}  // namespace sculpt
