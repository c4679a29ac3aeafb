// The Panda as ROS ships it, with mesh links and package:// references, in a cell of this test.
#include <gtest/gtest.h>

#include "tests/core/plan/jobs.hpp"

namespace sculpt {
namespace {

/// The room around the arm: floor, turntable, and a tool that starts below the fingers.
constexpr const char* room = R"(
  <link name="room"><collision><origin xyz="0.3 0 -0.05"/><geometry><box size="2 2 0.1"/></geometry></collision></link>
  <joint name="mount" type="fixed"><parent link="room"/><child link="panda_link0"/></joint>
  <link name="disc"><collision><origin xyz="0 0 -0.01"/><geometry><cylinder radius="0.1" length="0.02"/></geometry></collision></link>
  <joint name="table" type="continuous"><parent link="room"/><child link="disc"/><origin xyz="0.5 0 0.12"/><axis xyz="0 0 1"/></joint>
  <link name="nose"/>
  <joint name="nose_joint" type="fixed"><parent link="panda_hand"/><child link="nose"/><origin xyz="0 0 0.13"/></joint>
</robot>)";

TEST(RosPanda, WithMeshLinksCarvesAndReplaysClean) {
  const auto package = shared_data() / "ros/moveit_resources_panda_description";
  if (!std::filesystem::exists(package))
    GTEST_SKIP() << "no ROS Panda: set SCULPT_SHARED_DATA to the folder of shared data";
  const auto folder = std::filesystem::temp_directory_path() / ("sculpt-ros-panda-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  std::string urdf = read_file(package / "urdf/panda.urdf");
  urdf.replace(urdf.rfind("</robot>"), 8, room);
  std::ofstream(folder / "room.urdf") << urdf;
  std::ofstream(folder / "cell.json") << R"({"urdf": "room.urdf",
    "packages": {"moveit_resources_panda_description": ")"
                                      << std::filesystem::absolute(package).string() << R"("},
    "stock": {"link": "disc", "size_m": 0.16, "origin_m": [-0.08, -0.08, 0]},
    "tool": {"link": "nose", "stickout_m": 0.2, "ball_radius_voxels": 0.45, "shank_radius_voxels": 0.4},
    "home": {"panda_joint2": -0.139, "panda_joint4": -1.612, "panda_joint6": 1.473, "panda_joint7": 0.717, "panda_finger_joint1": 0.02}})";
  const CellFiles cell = read_cell_files(folder / "cell.json");
  std::filesystem::remove_all(folder);

  VoxelSet target(8);
  for (int k = 0; k < 5; ++k)
    for (int j = 2; j < 6; ++j)
      for (int i = 2; i < 6; ++i) target.insert({i, j, k});
  const ScratchFile file;
  const JobResult result = run_job(make_job(cell, target), file.path(), {});
  EXPECT_TRUE(result.report.verify.clean) << (result.report.findings.empty() ? "" : result.report.findings.front());
  EXPECT_EQ(result.report.voxels.removed + result.report.voxels.residue, result.report.voxels.remove);
  EXPECT_LE(result.report.voxels.residue * 20, result.report.voxels.remove) << report_json(result.report);
}

}  // namespace
}  // namespace sculpt
