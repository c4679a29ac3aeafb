#include "core/cell/milling/tool_library.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "core/base/error.hpp"
#include "core/cell/cell_field.hpp"
#include "core/cell/shipped_cells.hpp"

namespace sculpt {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr int max_number = 9999;
/// No tool of a spindle is larger: who writes 20 means millimetres.
constexpr double max_diameter_m = 0.3, max_length_m = 1.5, fastest_m_s = 10;
constexpr double min_m = 1e-5;
/// The sum of lengths may be off by what decimals leave.
constexpr double length_slack_m = 1e-9;

[[noreturn]] void refuse_tool(const std::string& where, const std::string& sentence) {
  throw InputError("tools_invalid", "tool library, " + where + ": " + sentence);
}

std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

/// A length above nothing and below `most`.
double read_length(const CellField& field, double most) {
  const double value = field.number();
  if (!(value >= min_m))
    refuse_tool(field.pointer(), text(value) + " is too small: give metres, at least " + text(min_m));
  if (value > most)
    refuse_tool(field.pointer(), text(value) + " m is more than any spindle holds (" + text(most) +
                                     " m): lengths are in metres, so 20 mm is 0.02");
  return value;
}

double read_speed(const CellField& field) {
  const double value = field.number();
  if (!(value > 0) || value > fastest_m_s)
    refuse_tool(field.pointer(),
                text(value) + " m/s is no feed: give metres per second, above 0 and at most " + text(fastest_m_s));
  return value;
}

Cutter read_cutter(const CellField& field) {
  field.require_object({"kind", "diameter_m", "corner_radius_m", "flute_m"});
  Cutter cutter;
  const std::string kind = field.at("kind").text();
  const auto kinds = {CutterKind::ball, CutterKind::bull, CutterKind::flat};
  const auto found = std::ranges::find_if(kinds, [&](CutterKind each) { return kind == name(each); });
  if (found == kinds.end()) refuse_tool(field.pointer() + "/kind", "'" + kind + "' is not ball, bull or flat");
  cutter.kind = *found;
  cutter.radius_m = read_length(field.at("diameter_m"), max_diameter_m) / 2;
  cutter.flute_m = read_length(field.at("flute_m"), max_length_m);
  if (cutter.kind == CutterKind::ball) cutter.corner_radius_m = cutter.radius_m;
  if (cutter.kind == CutterKind::bull)
    cutter.corner_radius_m = read_length(field.at("corner_radius_m"), max_diameter_m);
  else if (field.has("corner_radius_m"))
    refuse_tool(field.pointer() + "/corner_radius_m", "only a bull cutter has one: leave it out");
  if (cutter.corner_radius_m > cutter.radius_m)
    refuse_tool(field.pointer() + "/corner_radius_m", text(cutter.corner_radius_m) +
                                                          " m is more than half of diameter_m, " +
                                                          text(cutter.radius_m) + " m: make the diameter larger");
  if (cutter.flute_m < cutter.corner_radius_m)
    refuse_tool(field.pointer() + "/flute_m", "the flutes, " + text(cutter.flute_m) +
                                                  " m long, end within the cutter's round end of " +
                                                  text(cutter.corner_radius_m) + " m: make them longer");
  return cutter;
}

std::vector<HolderSection> read_body(const CellField& field) {
  std::vector<HolderSection> body;
  const std::vector<CellField> sections = field.elements();
  if (sections.empty() || sections.size() > max_sections)
    refuse_tool(field.pointer(), "give 1 to " + std::to_string(max_sections) + " sections: neck, shank, holder");
  for (const CellField& section : sections) {
    section.require_object({"length_m", "radius_m", "end_radius_m"});
    const double radius_m = read_length(section.at("radius_m"), max_diameter_m);
    const double end_m =
        section.has("end_radius_m") ? read_length(section.at("end_radius_m"), max_diameter_m) : radius_m;
    body.push_back({read_length(section.at("length_m"), max_length_m), radius_m, end_m});
  }
  if (body.size() > 1) {
    const HolderSection &below = body[body.size() - 2], &holder = body.back();
    if (std::max(holder.radius_m, holder.end_radius_m) < below.end_radius_m)
      refuse_tool(sections.back().pointer(),
                  "the holder, " + text(holder.radius_m) + " m in radius, is thinner than the shank below it, " +
                      text(below.end_radius_m) + " m: the sections go from the cutter upwards");
  }
  return body;
}

void check_lengths(const CellField& field, const MillTool& tool) {
  double length_m = tool.cutter.flute_m;
  for (const HolderSection& section : tool.body) length_m += section.length_m;
  if (length_m > tool.stickout_m + length_slack_m)
    refuse_tool(field.pointer() + "/stickout_m", "flutes and body of '" + tool.name + "' are " + text(length_m) +
                                                     " m long together, it sticks out by " + text(tool.stickout_m) +
                                                     " m only: stickout_m goes from the tool link's origin to the tip");
  if (tool.max_depth_m > tool.cutter.flute_m)
    refuse_tool(field.pointer() + "/max_depth_m", "a depth of cut of " + text(tool.max_depth_m) +
                                                      " m is more than the flutes are long, " +
                                                      text(tool.cutter.flute_m) + " m: make it less");
  if (tool.max_width_m > 2 * tool.cutter.radius_m)
    refuse_tool(field.pointer() + "/max_width_m", "a width of cut of " + text(tool.max_width_m) +
                                                      " m is more than the cutter's diameter, " +
                                                      text(2 * tool.cutter.radius_m) + " m: make it less");
}

/// Up to the spindle: what is above the last section is as thick as that.
void reach_the_spindle(MillTool& tool) {
  double length_m = tool.cutter.flute_m;
  for (const HolderSection& section : tool.body) length_m += section.length_m;
  const double missing_m = tool.stickout_m - length_m, radius_m = tool.body.back().end_radius_m;
  if (missing_m > length_slack_m) tool.body.push_back({missing_m, radius_m, radius_m});
}

MillTool read_tool(const CellField& field) {
  field.require_object({"name", "number", "cutter", "body", "stickout_m", "max_depth_m", "max_width_m", "feed_m_s",
                        "plunge_m_s", "spindle_rpm"});
  MillTool tool;
  tool.name = field.at("name").text();
  const double number = field.at("number").number();
  if (number != std::floor(number) || number < 1 || number > max_number)
    refuse_tool(field.pointer() + "/number", text(number) + " is no place in a magazine: give 1 to 9999");
  tool.number = static_cast<int>(number);
  tool.cutter = read_cutter(field.at("cutter"));
  tool.body = read_body(field.at("body"));
  tool.stickout_m = read_length(field.at("stickout_m"), max_length_m);
  tool.max_depth_m = read_length(field.at("max_depth_m"), max_length_m);
  tool.max_width_m = read_length(field.at("max_width_m"), max_diameter_m);
  tool.feed_m_s = read_speed(field.at("feed_m_s"));
  if (field.has("plunge_m_s")) tool.plunge_m_s = read_speed(field.at("plunge_m_s"));
  if (field.has("spindle_rpm")) tool.spindle_rpm = field.at("spindle_rpm").number_from(0);
  check_lengths(field, tool);
  reach_the_spindle(tool);
  return tool;
}

std::string list(const std::vector<MillTool>& tools) {
  std::string names;
  for (const MillTool& tool : tools) names += (names.empty() ? "" : ", ") + tool.name;
  return names;
}

std::string read_bytes(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream bytes;
  std::error_code ignored;
  if (!in || fs::is_directory(path, ignored) || !(bytes << in.rdbuf()).good())
    throw InputError("file_missing", "tool library '" + path.string() +
                                         "' cannot be read, or is empty: check the path and its permissions");
  return bytes.str();
}

}  // namespace

std::vector<MillTool> parse_tool_library(const ToolLibraryFile& file) try {
  const json document = parse_document(file.json, "tools_invalid", "the tool library '" + file.name + "'");
  const CellField top(document, "");
  top.require_object({"tools"});
  std::vector<MillTool> tools;
  for (const CellField& field : top.at("tools").elements()) {
    MillTool tool = read_tool(field);
    if (std::ranges::find(tools, tool.name, &MillTool::name) != tools.end())
      refuse_tool(field.pointer() + "/name", "there are two tools '" + tool.name + "': give each a name of its own");
    tools.push_back(std::move(tool));
  }
  return tools;
} catch (const InputError& error) {
  if (error.code() != "cell_invalid") throw;
  std::string sentence = error.what();  // the reader of single fields calls every file a cell file
  const std::string_view cell_file = "cell file, ";
  if (sentence.starts_with(cell_file)) sentence = "tool library, " + sentence.substr(cell_file.size());
  throw InputError("tools_invalid", sentence);
}

std::vector<MillTool> choose_tools(const ToolLibraryFile& file, const std::vector<std::string>& names) {
  if (names.empty()) throw InputError("tools_invalid", "no tool is named: give --tools, for example D20,D6");
  if (names.size() > max_tools)
    throw InputError("tools_invalid", std::to_string(names.size()) + " tools are named: at most " +
                                          std::to_string(max_tools) + " can be used in one job");
  const std::vector<MillTool> known = parse_tool_library(file);
  std::vector<MillTool> chosen;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(known, name, &MillTool::name);
    if (found == known.end())
      throw InputError("tools_invalid", "the tool library '" + file.name + "' has no tool '" + name +
                                            "'; its tools are: " + list(known));
    if (std::ranges::find(chosen, name, &MillTool::name) != chosen.end())
      throw InputError("tools_invalid", "tool '" + name + "' is named twice: name each once");
    chosen.push_back(*found);
  }
  return chosen;
}

std::vector<fs::path> tool_folders(std::vector<fs::path> cells) {
  if (const char* named = std::getenv("SCULPT_TOOLS")) return {named};
  for (fs::path& folder : cells) folder = folder.parent_path() / "tools";
  return cells;
}

std::vector<fs::path> shipped_tool_folders() {
  return tool_folders(shipped_cell_folders());
}

std::vector<ToolLibraryFile> read_tool_libraries(const std::vector<fs::path>& folders) {
  std::vector<ToolLibraryFile> libraries;
  for (const std::string& name : cell_names(folders)) try {
      libraries.push_back(read_tool_library(name, folders));
    } catch (const InputError&) {
      // Who asks for it by its name is told why it cannot be read.
    }
  return libraries;
}

ToolLibraryFile read_tool_library(const std::string& library, const std::vector<fs::path>& folders) {
  if (library.find('/') != std::string::npos || library.ends_with(".json"))
    return {fs::path(library).stem().string(), read_bytes(library)};
  std::error_code ignored;
  for (const fs::path& folder : folders)
    if (const fs::path file = folder / (library + ".json"); fs::is_regular_file(file, ignored))
      return {library, read_bytes(file)};
  std::string known;
  for (const std::string& name : cell_names(folders)) known += (known.empty() ? "" : ", ") + name;
  throw InputError("tools_invalid", "there is no tool library '" + library + "'; known: " +
                                        (known.empty() ? "none (set SCULPT_TOOLS to their folder)" : known) +
                                        "; or give the path of a file (with a '/' or ending in .json)");
}

}  // namespace sculpt
