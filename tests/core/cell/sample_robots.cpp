#include "tests/core/cell/sample_robots.hpp"

#include <stdlib.h>

#include <fstream>
#include <stdexcept>

#include "core/cell/shipped_cells.hpp"

namespace sculpt {

namespace {

const char* const rail_urdf = R"(<robot name="arm-on-rail">
  <link name="room"/> <link name="carriage"/> <link name="upper"/> <link name="fore"/> <link name="hand"/> <link name="bench"/>
  <joint name="bench_mount" type="fixed">
    <parent link="room"/> <child link="bench"/> <origin xyz="0.8 0.1 0.3" rpy="0 0 0.4"/>
  </joint>
  <joint name="rail" type="prismatic">
    <parent link="room"/> <child link="carriage"/> <origin xyz="0 -0.2 0.5"/>
    <axis xyz="0 2 0"/> <limit lower="-0.5" upper="0.7" velocity="1" effort="1"/>
  </joint>
  <joint name="shoulder" type="revolute">
    <parent link="carriage"/> <child link="upper"/> <origin xyz="0.1 0 0.1" rpy="0.1 0.2 0.3"/>
    <axis xyz="0 1 0"/> <limit lower="-1.5" upper="1.5" velocity="1" effort="1"/>
  </joint>
  <joint name="elbow" type="revolute">
    <parent link="upper"/> <child link="fore"/> <origin xyz="0.4 0 0"/>
    <axis xyz="1 1 1"/> <limit lower="-2" upper="0.5" velocity="1" effort="1"/>
  </joint>
  <joint name="wrist" type="continuous">
    <parent link="fore"/> <child link="hand"/> <origin xyz="0.3 0.05 0" rpy="0 1.2 0"/> <axis xyz="-1 0 0.2"/>
  </joint>
</robot>)";

const char* const mimic_urdf = R"(<robot name="mimic-machine">
  <link name="bed"/> <link name="cradle"/> <link name="plate"/> <link name="column"/> <link name="slide1"/> <link name="bracket"/>
  <link name="slide2"/> <link name="head"/> <link name="spare"/>
  <joint name="tilt" type="revolute">
    <parent link="bed"/> <child link="cradle"/> <origin xyz="0.2 0 0.1"/>
    <axis xyz="1 0 0"/> <limit lower="-1" upper="1" velocity="1" effort="1"/>
  </joint>
  <joint name="turn" type="continuous">
    <parent link="cradle"/> <child link="plate"/> <origin xyz="0 0.05 0.1" rpy="0.1 0 0"/> <axis xyz="0 0 1"/>
  </joint>
  <joint name="column_mount" type="fixed">
    <parent link="bed"/> <child link="column"/> <origin xyz="-0.3 0 0.2" rpy="0 0.3 0"/>
  </joint>
  <joint name="slide" type="prismatic">
    <parent link="column"/> <child link="slide1"/>
    <axis xyz="0 0 1"/> <limit lower="-0.2" upper="0.4" velocity="1" effort="1"/>
  </joint>
  <joint name="bracket_mount" type="fixed">
    <parent link="slide1"/> <child link="bracket"/> <origin xyz="0.1 0 0" rpy="0 0 0.5"/>
  </joint>
  <joint name="telescope" type="prismatic">
    <parent link="bracket"/> <child link="slide2"/> <axis xyz="1 0 0"/>
    <limit lower="-1" upper="1" velocity="1" effort="1"/> <mimic joint="slide" multiplier="1.5" offset="0.02"/>
  </joint>
  <joint name="nod" type="revolute">
    <parent link="slide2"/> <child link="head"/> <origin xyz="0.1 0 0"/> <axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" velocity="1" effort="1"/> <mimic joint="telescope" multiplier="-2" offset="0.3"/>
  </joint>
  <joint name="flap" type="revolute">
    <parent link="column"/> <child link="spare"/> <axis xyz="0 1 0"/>
    <limit lower="0.5" upper="1" velocity="1" effort="1"/>
  </joint>
</robot>)";

/// Every movable joint at 0, or at the limit that is nearest to 0.
std::vector<double> zero_rest(const Robot& robot) {
  std::vector<double> rest;
  for (const Joint& joint : robot.joints) rest.push_back(std::clamp(0.0, joint.lower, joint.upper));
  return rest;
}

}  // namespace

Robot parse_plain(const std::string& xml) {
  return parse_urdf(xml, [](const std::string& reference) -> std::string {
    throw std::logic_error("no file was expected, but " + reference);
  });
}

Cell shipped_cell(const std::string& name) {
  return parse_cell(read_cell_files(find_cell(name, {SOURCE_DIR "/config/cells"})));
}

Chain SampleChain::chain() const {
  return Chain(robot, robot.find_link(stock), robot.find_link(tool), stickout_m, zero_rest(robot));
}

SampleChain arm_on_rail() {
  return {"arm on a rail", parse_plain(rail_urdf), "bench", "hand", 0.15};
}

SampleChain mimic_machine() {
  return {"machine with mimic joints", parse_plain(mimic_urdf), "plate", "head", 0.12};
}

SampleChain shipped_chain(const Cell& cell) {
  const auto link = [&](int index) { return cell.robot.links[static_cast<std::size_t>(index)].name; };
  return {cell.name, cell.robot, link(cell.stock_link), link(cell.tool_link), cell.tool.stickout_m};
}

Configuration random_configuration(const Chain& chain, Random& random, double margin) {
  Configuration q(chain.dof());
  for (int c = 0; c < chain.dof(); ++c) {
    const double spare = margin * (chain.upper()[c] - chain.lower()[c]);
    q[c] = random.between(chain.lower()[c] + spare, chain.upper()[c] - spare);
  }
  return q;
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "sculpt-cell-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

void TemporaryFolder::write(const std::string& name, const std::string& content) const {
  std::filesystem::create_directories((path_ / name).parent_path());
  std::ofstream(path_ / name, std::ios::binary) << content;
}

}  // namespace sculpt
