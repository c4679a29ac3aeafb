#include "core/cell/milling/tool_library.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/base/error.hpp"

namespace sculpt {
namespace {

using nlohmann::json;

json shipped() {
  std::ifstream in(SOURCE_DIR "/config/tools/carving.json");
  return json::parse(in);
}

std::string refusal(const json& library, const std::vector<std::string>& names = {"D20", "D6"}) {
  try {
    choose_tools({"mine", library.dump()}, names);
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), "tools_invalid");
    return error.what();
  }
  return {};
}

TEST(ToolLibrary, HoldsToolsThatCanBeBought) {
  const auto tools = choose_tools({"carving", shipped().dump()}, {"D20", "D12", "D6", "D3"});
  ASSERT_EQ(tools.size(), 4U);
  EXPECT_EQ(tools[0].cutter.kind, CutterKind::ball);
  EXPECT_DOUBLE_EQ(tools[0].cutter.radius_m, 0.01);
  EXPECT_DOUBLE_EQ(tools[0].cutter.height_m(0.01), 0.01);
  EXPECT_DOUBLE_EQ(tools[0].cutter.height_m(0), 0);
  for (const MillTool& tool : tools) {
    double length = tool.cutter.flute_m;
    for (const HolderSection& section : tool.body) length += section.length_m;
    EXPECT_NEAR(length, tool.stickout_m, 1e-9) << tool.name;
  }
}

TEST(ToolLibrary, IsUsedInTheOrderOfTheJob) {
  const auto tools = choose_tools({"carving", shipped().dump()}, {"D3", "D20"});
  ASSERT_EQ(tools.size(), 2U);
  EXPECT_EQ(tools[0].name, "D3");
  EXPECT_EQ(tools[1].name, "D20");
}

TEST(ToolLibrary, ABodyThatEndsBelowTheSpindleGoesOnAsThick) {
  json library = shipped();
  library["tools"][0]["stickout_m"] = 0.25;
  const auto tools = choose_tools({"mine", library.dump()}, {"D20"});
  EXPECT_NEAR(tools[0].body.back().length_m, 0.05, 1e-12);
  EXPECT_DOUBLE_EQ(tools[0].body.back().radius_m, 0.031);
}

TEST(ToolLibrary, RefusesWhatCannotBeWithPlaceAndCure) {
  EXPECT_NE(refusal(shipped(), {"D20", "D7"}).find("no tool 'D7'; its tools are: D20, D12, D6, D3"), std::string::npos);
  EXPECT_NE(refusal(shipped(), {"D20", "D20"}).find("named twice"), std::string::npos);
  EXPECT_NE(refusal(shipped(), {}).find("--tools"), std::string::npos);
  EXPECT_NE(refusal(shipped(), std::vector<std::string>(17, "D20")).find("17 tools"), std::string::npos);
  struct Fault {
    const char* pointer;
    json value;
    const char* said;
  };
  const std::vector<Fault> faults{
      {"/tools/0/cutter/diameter_m", 20, "lengths are in metres"},
      {"/tools/0/cutter/diameter_m", 0, "too small"},
      {"/tools/0/cutter/diameter_m", -0.01, "too small"},
      {"/tools/0/cutter/kind", "cone", "not ball, bull or flat"},
      {"/tools/0/cutter/kind", "bull", "corner_radius_m"},
      {"/tools/0/cutter/flute_m", 0.005, "round end"},
      {"/tools/0/cutter/corner_radius_m", 0.002, "only a bull cutter"},
      {"/tools/0/body", json::array(), "1 to 16 sections"},
      {"/tools/0/body/1/radius_m", 0.004, "thinner than the shank"},
      {"/tools/0/body/1/length_m", 0.2, "stickout_m goes from"},
      {"/tools/0/stickout_m", 0, "too small"},
      {"/tools/0/stickout_m", 200, "metres"},
      {"/tools/0/max_depth_m", 0.07, "more than the flutes are long"},
      {"/tools/0/max_width_m", 0.03, "more than the cutter's diameter"},
      {"/tools/0/feed_m_s", 0, "no feed"},
      {"/tools/0/feed_m_s", 100, "no feed"},
      {"/tools/0/number", 0.5, "no place in a magazine"},
      {"/tools/1/name", "D20", "two tools 'D20'"},
      {"/tools/0/colour", "red", "unknown field"},
      {"/tools/0/name", "", "not empty"},
      {"/tools", 5, "array"},
  };
  for (const Fault& fault : faults) {
    json library = shipped();
    library[json::json_pointer(fault.pointer)] = fault.value;
    const std::string said = refusal(library);
    EXPECT_NE(said.find(fault.said), std::string::npos) << fault.pointer << ": " << said;
    EXPECT_NE(said.find("tool library"), std::string::npos) << said;
  }
  EXPECT_THROW(choose_tools({"mine", "{"}, {"D20"}), InputError);
  EXPECT_THROW(choose_tools({"mine", std::string(100, '[')}, {"D20"}), InputError);
}

TEST(ToolLibrary, IsFoundByNameOrPath) {
  EXPECT_EQ(read_tool_library("carving", {SOURCE_DIR "/config/tools"}).name, "carving");
  EXPECT_EQ(read_tool_library(SOURCE_DIR "/config/tools/carving.json", {}).name, "carving");
  EXPECT_THROW(read_tool_library("nothing", {SOURCE_DIR "/config/tools"}), InputError);
  EXPECT_THROW(read_tool_library("./nothing.json", {}), InputError);
}

TEST(ToolLibrary, OfAFolderThoseThatCanBeReadAreThere) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("sculpt-tools-" + std::to_string(getpid())),
                 other = folder / "x";
  fs::create_directories(other);
  fs::create_directories(folder / "no-file.json");
  std::ofstream(folder / "b.json") << "one";
  std::ofstream(other / "b.json") << "another";
  std::ofstream(other / "a.json") << "two";
  std::string found;
  for (const ToolLibraryFile& library : read_tool_libraries({folder, folder / "nowhere", other}))
    found += library.name + "=" + library.json + " ";
  EXPECT_EQ(found, "a=two b=one ");
  fs::remove_all(folder);
}

}  // namespace
}  // namespace sculpt
