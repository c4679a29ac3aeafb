#include "core/trajectory/trajectory_line.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "core/base/error.hpp"
#include "core/material/resolution.hpp"
#include "core/trajectory/number_text.hpp"

namespace sculpt {
namespace {

using Json = nlohmann::json;

constexpr int deepest_nesting = 8;

[[noreturn]] void refuse(const std::string& where, const std::string& what) {
  throw InputError("trajectory_invalid", where + ": " + what + "; fetch or plan the trajectory again");
}

template <typename Values>
void append_numbers(std::string& text, const Values& values) {
  text += '[';
  bool first = true;
  for (double value : values) {
    if (!first) text += ',';
    append_number(text, value);
    first = false;
  }
  text += ']';
}

char* write_text(char* out, std::string_view text) {
  std::memcpy(out, text.data(), text.size());
  return out + text.size();
}

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
      if (++depth > deepest_nesting) return true;
    } else if (!quoted && (c == ']' || c == '}')) {
      --depth;
    }
  }
  return false;
}

Json parse_object(std::string_view text, const std::string& where) {
  if (nested_too_deep(text))
    refuse(where, "brackets are nested more than " + std::to_string(deepest_nesting) + " deep");
  try {
    Json value = Json::parse(text.begin(), text.end());
    if (!value.is_object()) refuse(where, "not a JSON object");
    return value;
  } catch (const Json::exception&) {
    refuse(where, "not JSON");
  }
}

// Typed access to the fields of one object; every refusal names the field.
class Fields {
 public:
  Fields(const Json& object, const std::string& where) : object_(object), where_(where) {}

  const Json& get(const char* key) const {
    const auto found = object_.find(key);
    if (found == object_.end()) refuse(where_, std::string("field \"") + key + "\" is missing");
    return *found;
  }
  std::string text(const char* key) const {
    const Json& value = get(key);
    if (!value.is_string()) refuse(where_, std::string("field \"") + key + "\" is not a string");
    return value.get<std::string>();
  }
  double number(const char* key, double least) const { return checked(get(key), key, least); }
  std::uint64_t count(const char* key) const {
    const Json& value = get(key);
    if (!value.is_number_unsigned())
      refuse(where_, std::string("field \"") + key + "\" is not a whole number from 0 up");
    return value.get<std::uint64_t>();
  }
  /// False where it is missing.
  bool flag(const char* key) const {
    const auto found = object_.find(key);
    if (found == object_.end()) return false;
    if (!found->is_boolean()) refuse(where_, std::string("field \"") + key + "\" is neither true nor false");
    return found->get<bool>();
  }
  const Json& array(const char* key, std::size_t least, std::size_t most) const {
    const Json& value = get(key);
    if (!value.is_array() || value.size() < least || value.size() > most)
      refuse(where_, std::string("field \"") + key + "\" is not a list of " + std::to_string(least) +
                         (least == most ? "" : " to " + std::to_string(most)) + " values");
    return value;
  }
  Configuration numbers(const char* key, std::size_t size) const {
    const Json& values = array(key, size, size);
    Configuration q(static_cast<Eigen::Index>(size));
    for (std::size_t at = 0; at < size; ++at)
      q[static_cast<Eigen::Index>(at)] = checked(values[at], key, -std::numeric_limits<double>::max());
    return q;
  }

 private:
  double checked(const Json& value, const char* key, double least) const {
    if (!value.is_number()) refuse(where_, std::string("field \"") + key + "\" holds something that is not a number");
    const double number = value.get<double>();
    if (!std::isfinite(number) || number < least) refuse(where_, std::string("field \"") + key + "\" is out of range");
    return number;
  }

  const Json& object_;
  const std::string& where_;
};

Voxel parse_voxel(const Json& value, const std::string& where) {
  std::array<int, 3> at{};
  if (!value.is_array() || value.size() != 3) refuse(where, "a voxel is not a list of 3 whole numbers");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!value[axis].is_number_unsigned() || value[axis].get<std::uint64_t>() >= max_resolution)
      refuse(where, "a voxel index is not a whole number from 0 to " + std::to_string(max_resolution - 1));
    at[axis] = value[axis].get<int>();
  }
  return {at[0], at[1], at[2]};
}

}  // namespace

void append_number(std::string& text, double value) {
  std::array<char, max_number_bytes> digits;
  text.append(digits.data(), write_number(digits.data(), value));
}

std::string header_line(const TrajectoryHeader& header) {
  std::string text = R"({"type":"header","format":1,"joints":)" + json_text(header.joints) + R"(,"home":)";
  append_numbers(text, header.home);
  text += R"(,"resolution":)" + std::to_string(header.grid.n) + R"(,"voxel_m":)";
  append_number(text, header.grid.voxel_m);
  text += R"(,"origin_m":)";
  append_numbers(text, header.grid.origin_m);
  text += R"(,"tool":{"ball_radius_m":)";
  append_number(text, header.tool.ball_radius_m);
  text += R"(,"shank_radius_m":)";
  append_number(text, header.tool.shank_radius_m);
  text += R"(,"stickout_m":)";
  append_number(text, header.tool.stickout_m);
  text += R"(},"tolerance_m":)";
  append_number(text, header.tolerance_m);
  text += R"(,"cell":)" + json_text(header.cell) + R"(,"search":)" + json_text(header.search);
  return text + R"(,"seed":)" + std::to_string(header.seed) + (header.held ? R"(,"held":true})" : "}");
}

std::size_t max_keyframe_line_bytes(std::size_t joints) {
  return 128 + joints * (max_number_bytes + 1);
}

char* write_keyframe_line(char* out, const Keyframe& keyframe) {
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
  const Fields fields(object, where);
  if (fields.text("type") != "header") refuse(where, "the first line is not a header");
  if (fields.count("format") != 1) refuse(where, "format " + fields.get("format").dump() + " is not known, only 1");
  TrajectoryHeader header;
  std::set<std::string> seen;
  for (const Json& joint : fields.array("joints", 1, max_joints)) {
    if (!joint.is_string() || !seen.insert(joint.get<std::string>()).second)
      refuse(where, "field \"joints\" is not a list of different names");
    header.joints.push_back(joint.get<std::string>());
  }
  header.home = fields.numbers("home", header.joints.size());
  const std::uint64_t resolution = fields.count("resolution");
  if (resolution < 1 || resolution > max_resolution)
    refuse(where, "resolution " + std::to_string(resolution) + " is not in 1 to " + std::to_string(max_resolution));
  header.grid.n = static_cast<int>(resolution);
  header.grid.voxel_m = fields.number("voxel_m", std::numeric_limits<double>::min());
  header.grid.origin_m = fields.numbers("origin_m", 3);
  const Json& tool_object = fields.get("tool");
  if (!tool_object.is_object()) refuse(where, "field \"tool\" is not an object");
  const Fields tool(tool_object, where);
  header.tool = {tool.number("ball_radius_m", 0), tool.number("shank_radius_m", 0), tool.number("stickout_m", 0)};
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
    refuse(where, "the voxels of a cut do not lie along one axis");
  refuse(where, "a voxel is outside the grid of " + std::to_string(grid.n));
}

TrajectoryLine parse_line(std::string_view text, const TrajectoryHeader& header, const std::string& where) {
  const Json object = parse_object(text, where);
  const Fields fields(object, where);
  const std::string type = fields.text("type");
  TrajectoryLine line;
  if (type == "end") {
    line.is_end = true;
    line.end = {fields.count("keyframes"), fields.count("removed"), fields.text("sha256")};
    return line;
  }
  if (type != "move" && type != "cut") refuse(where, "field \"type\" is not move, cut or end");
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
