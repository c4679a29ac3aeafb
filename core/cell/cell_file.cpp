// A cell file, and the files that it names, as JSON and text -> Cell.
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "core/base/error.hpp"
#include "core/cell/cell.hpp"
#include "core/cell/cell_field.hpp"
#include "core/cell/cell_motion.hpp"
#include "core/cell/mesh_reference.hpp"

namespace sculpt {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

using Field = CellField;

Field top_level(const json& document) {
  Field top(document, "");
  top.require_object({"name", "urdf", "packages", "stock", "tool", "home", "tool_change", "ignore_pairs", "check_pairs",
                      "limits", "programs"});
  return top;
}

std::string read_bytes(const fs::path& path, const std::string& what) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream bytes;
  std::error_code ignored;
  if (!in || fs::is_directory(path, ignored) || !(bytes << in.rdbuf()).good()) {
    throw InputError("file_missing",
                     what + " '" + path.string() + "' cannot be read, or is empty: check the path and its permissions");
  }
  return bytes.str();
}

int find_link(const Robot& robot, const Field& field) {
  const std::string name = field.text();
  const int link = robot.find_link(name);
  if (link >= 0) return link;
  std::string names;
  for (const Link& each : robot.links) names += (names.empty() ? "" : ", ") + each.name;
  refuse(field.pointer(), "the URDF has no link '" + name + "'; its links are: " + names);
}

/// Reads one radius, given either in voxels or in metres.
double read_radius(const Field& tool, const std::string& part, bool in_voxels) {
  const std::string name = part + (in_voxels ? "_radius_voxels" : "_radius_m");
  return tool.has(name) ? tool.at(name).number_from(0) : 0;
}

/// Reads a length that is more than nothing.
double read_extent(const Field& field) {
  return field.number_from(1e-6);
}

/// From the link's origin towards the ball.
std::vector<HolderSection> parse_holder(const Field& field, double stickout_m) {
  std::vector<HolderSection> holder;
  double length_m = 0;
  if (field.elements().size() > max_sections)
    refuse(field.pointer(), "give at most " + std::to_string(max_sections) + " sections");
  for (const Field& section : field.elements()) {
    section.require_object({"length_m", "radius_m", "end_radius_m"});
    const double radius_m = read_extent(section.at("radius_m"));
    const double end_m = section.has("end_radius_m") ? read_extent(section.at("end_radius_m")) : radius_m;
    holder.push_back({read_extent(section.at("length_m")), radius_m, end_m});
    length_m += holder.back().length_m;
  }
  if (!holder.empty() && length_m >= stickout_m) {
    std::ostringstream text;
    text << "its sections are " << length_m << " m long together, the tool sticks out by " << stickout_m
         << " m only: stickout_m counts from the link's origin to the ball's centre and must be the longer one";
    refuse(field.pointer(), text.str());
  }
  return holder;
}

ToolSpec parse_tool(const Field& field) {
  field.require_object(
      {"link", "stickout_m", "ball_radius_voxels", "shank_radius_voxels", "ball_radius_m", "shank_radius_m", "holder"});
  ToolSpec tool;
  tool.in_voxels = field.has("ball_radius_voxels");
  const std::string other = tool.in_voxels ? "_radius_m" : "_radius_voxels";
  for (const std::string part : {"ball", "shank"}) {
    if (field.has(part + other) && (field.has("ball_radius_voxels") || field.has("ball_radius_m"))) {
      refuse(field.pointer() + "/" + part + other,
             "give the radii of ball and shank either both in voxels or both in metres");
    }
  }
  if (!tool.in_voxels && !field.has("ball_radius_m")) {
    refuse(field.pointer(), "missing field: give ball_radius_voxels or ball_radius_m");
  }
  tool.ball_radius = read_radius(field, "ball", tool.in_voxels);
  tool.shank_radius = read_radius(field, "shank", tool.in_voxels);
  tool.stickout_m = field.has("stickout_m") ? field.at("stickout_m").length_from(0) : 0;
  if (tool.ball_radius <= 0) refuse(field.pointer(), "the ball's radius must be above 0");
  if (tool.shank_radius > tool.ball_radius) refuse(field.pointer(), "the shank must not be thicker than the ball");
  if (field.has("holder")) tool.holder = parse_holder(field.at("holder"), tool.stickout_m);
  return tool;
}

/// What the stock stands on: a square post under its middle.
Shape post_shape(const Field& field, const Cell& cell) {
  field.require_object({"height_m", "width_m"});
  const double height_m = read_extent(field.at("height_m")), width_m = read_extent(field.at("width_m"));
  Shape post;
  post.sides_m = {width_m, width_m, height_m};
  post.pose.translation() = cell.stock_origin_m + Vec3(cell.stock_size_m, cell.stock_size_m, -height_m) / 2;
  return post;
}

/// Every joint of the robot: 0 as far as its limits allow.
std::vector<double> rest_of(const Robot& robot) {
  std::vector<double> rest;
  for (const Joint& joint : robot.joints)
    rest.push_back(joint.kind == JointKind::fixed ? 0.0 : std::clamp(0.0, joint.lower, joint.upper));
  return rest;
}

/// The joint that `name` names and home may set. Throws InputError.
std::size_t home_joint(const Robot& robot, const std::string& name, const Field& value) {
  const int index = robot.find_joint(name);
  if (index < 0) refuse(value.pointer(), "the URDF has no such joint");
  const Joint& joint = robot.joints[static_cast<std::size_t>(index)];
  if (joint.kind == JointKind::fixed) refuse(value.pointer(), "this joint is fixed: leave it out");
  if (joint.mimic >= 0)
    refuse(value.pointer(),
           "this joint follows '" + robot.joints[static_cast<std::size_t>(joint.mimic)].name + "': give that one");
  return static_cast<std::size_t>(index);
}

/// Its value at home, at the limit where it is beyond one: that is a fault.
double home_value(const Joint& joint, const Field& value, std::vector<InputError>& faults) {
  const double q = value.number();
  if (q >= joint.lower && q <= joint.upper) return q;
  std::ostringstream text;
  text << q << " is outside the joint's limits of " << joint.lower << " to " << joint.upper;
  faults.push_back(cell_error(value.pointer(), text.str()));
  return std::clamp(q, joint.lower, joint.upper);
}

/// Every joint of the robot: the value that the object `name` gives, else that of `rest`. What is wrong with one is a
/// fault.
std::vector<double> parse_posture(const Robot& robot, const Field& top, const std::string& name,
                                  std::vector<double> rest, std::vector<InputError>& faults) {
  try {
    for (const auto& [joint_name, value] : top.at(name).members()) {
      try {
        const std::size_t joint = home_joint(robot, joint_name, value);
        rest[joint] = home_value(robot.joints[joint], value, faults);
      } catch (const InputError& error) {
        faults.push_back(error);
      }
    }
  } catch (const InputError& error) {
    faults.push_back(error);
  }
  follow_leaders(robot, rest);
  return rest;
}

/// Where milling tools are changed.
std::vector<double> parse_change(const Cell& cell, const Field& top) {
  const std::vector<int> moved = cell.chain().joints();
  if (!top.has("tool_change")) return cell.rest;
  std::vector<InputError> faults;
  std::vector<double> change = parse_posture(cell.robot, top, "tool_change", cell.rest, faults);
  if (!faults.empty()) throw faults.front();
  for (const auto& [name, value] : top.at("tool_change").members()) {
    const int joint = cell.robot.find_joint(name);
    if (std::ranges::find(moved, joint) == moved.end())
      refuse(value.pointer(),
             "this joint does not move the tool against the stock, so it stays as at home: leave it out");
  }
  return change;
}

/// Pairs of links under `name`, none if the field is not there.
std::vector<LinkPair> parse_pairs(const Robot& robot, const Field& top, const std::string& name) {
  std::vector<LinkPair> pairs;
  if (!top.has(name)) return pairs;
  for (const Field& pair : top.at(name).elements()) {
    const std::vector<Field> links = pair.elements();
    if (links.size() != 2)
      refuse(pair.pointer(), "must be two names of links, not " + std::to_string(links.size()) + " values");
    const int first = find_link(robot, links[0]), second = find_link(robot, links[1]);
    if (first == second) refuse(pair.pointer(), "'" + links[0].text() + "' twice: name two links");
    pairs.emplace_back(std::minmax(first, second));
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

void refuse_contradictions(const Cell& cell) {
  for (const auto& [a, b] : cell.check_pairs) {
    if (!std::binary_search(cell.ignore_pairs.begin(), cell.ignore_pairs.end(), LinkPair{a, b})) continue;
    const auto& links = cell.robot.links;
    refuse("/check_pairs", "'" + links[static_cast<std::size_t>(a)].name + "' and '" +
                               links[static_cast<std::size_t>(b)].name +
                               "' stand in ignore_pairs as well: take the pair out of one of the two");
  }
}

const std::string& file_named(const CellFiles& files, const std::string& name) {
  const auto at = files.files.find(name);
  if (at == files.files.end())
    throw InputError("file_missing", "'" + name + "' did not come with the cell: send it along");
  return at->second;
}

}  // namespace

CellFiles read_cell_files(const fs::path& path) {
  CellFiles files;
  files.name = path.stem().string();
  files.cell_json = read_bytes(path, "cell file");
  const json document = parse_document(files.cell_json, "cell_invalid", "the cell file");
  const Field top = top_level(document);
  const std::string urdf_name = top.at("urdf").text();
  const fs::path urdf = path.parent_path() / urdf_name;
  files.files[urdf_name] = read_bytes(urdf, "the cell's URDF");
  const auto named = [&](const std::string& package) -> std::optional<fs::path> {
    if (top.has("packages"))
      for (const auto& [name, folder] : top.at("packages").members())
        if (name == package) return path.parent_path() / folder.text();
    return std::nullopt;
  };
  // Parsing is what knows which meshes there are.
  parse_urdf(files.files[urdf_name], [&](const std::string& reference) {
    return files.files[reference] = read_bytes(find_mesh_file(reference, urdf, named), "mesh");
  });
  return files;
}

CellDraft draft_cell(const CellFiles& files) {
  const json document = parse_document(files.cell_json, "cell_invalid", "the cell file");
  const Field top = top_level(document);
  CellDraft draft;
  Cell& cell = draft.cell;
  cell.name = top.has("name") ? top.at("name").text() : files.name;
  if (top.has("packages")) {
    for (const auto& [package, folder] : top.at("packages").members()) folder.text();
  }
  const Field stock = top.at("stock"), tool = top.at("tool");
  stock.require_object({"link", "size_m", "origin_m", "post"});
  cell.stock_size_m = stock.at("size_m").length_from(1e-6);
  cell.stock_origin_m = stock.at("origin_m").position();
  cell.tool = parse_tool(tool);
  cell.urdf = file_named(files, top.at("urdf").text());
  cell.robot = parse_urdf(cell.urdf, [&](const std::string& reference) { return file_named(files, reference); });
  cell.stock_link = find_link(cell.robot, stock.at("link"));
  cell.tool_link = find_link(cell.robot, tool.at("link"));
  for (Shape& shape : holder_shapes(cell.tool))  // to whoever looks at links the holder is part of one
    cell.robot.links[static_cast<std::size_t>(cell.tool_link)].shapes.push_back(std::move(shape));
  if (stock.has("post")) {
    const Shape post = post_shape(stock.at("post"), cell);
    cell.robot.links[static_cast<std::size_t>(cell.stock_link)].shapes.push_back(post);
    cell.has_post = true;
  }
  cell.rest = parse_posture(cell.robot, top, "home", rest_of(cell.robot), draft.home_faults);
  cell.ignore_pairs = parse_pairs(cell.robot, top, "ignore_pairs");
  cell.check_pairs = parse_pairs(cell.robot, top, "check_pairs");
  refuse_contradictions(cell);
  cell.limits = top.has("limits") ? parse_limits(cell.robot, top.at("limits")) : limits_of_urdf(cell.robot);
  if (top.has("programs")) cell.programs = parse_programs(cell.robot, top.at("programs"));
  cell.change = parse_change(cell, top);  // refuses a cell in which nothing moves the tool
  return draft;
}

Cell parse_cell(const CellFiles& files) {
  CellDraft draft = draft_cell(files);
  if (!draft.home_faults.empty()) throw draft.home_faults.front();
  return std::move(draft.cell);
}

}  // namespace sculpt
