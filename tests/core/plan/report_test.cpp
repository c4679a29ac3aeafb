#include <gtest/gtest.h>

#include "tests/core/plan/jobs.hpp"

namespace sculpt {
namespace {

TEST(Report, IsOneLineWithTheFieldsThatChecksRelyOn) {
  Report report;
  report.mesh = "a \"quoted\" name\xff.stl";
  report.residue = {{Reason::tool_cannot_reach, 3}};
  report.unchecked_links = {{"fore", "nose", "ignore_pairs"}};
  report.verify.exempt_pairs = {{"base", "arm", "a bearing"}};
  const std::string json = report_json(report);
  EXPECT_EQ(json.find('\n'), std::string::npos);
  for (const char* field : {"\"mesh\":",
                            "\"robot\":",
                            "\"search\":",
                            "\"seed\":",
                            "\"resolution\":",
                            "\"voxels\":{\"total\":",
                            "\"removed\":",
                            "\"loose_keep\":",
                            "\"loose_keep_pieces\":",
                            "\"freed\":",
                            "\"ambiguous\":",
                            "\"residue\":[{\"reason\":\"tool cannot reach\",\"voxels\":3}]",
                            "\"octree\":{\"leaves\":",
                            "\"remove_leaves\":",
                            "\"path\":{\"keyframes\":",
                            "\"rows\":",
                            "\"transits\":",
                            "\"cut_m\":",
                            "\"travel_m\":",
                            "\"joint_travel_rad\":",
                            "\"seconds\":{\"load\":",
                            "\"unchecked_links\":[{\"links\":[\"fore\",\"nose\"],\"why\":\"ignore_pairs\"}]",
                            "\"peak_memory_bytes\":",
                            "\"threads\":",
                            "\"plan_sha256\":",
                            "\"verify\":{\"clean\":false",
                            "\"collisions\":",
                            "\"voxels_checked\":",
                            "\"exempt_pairs\":[{\"links\":[\"base\",\"arm\"],\"why\":\"a bearing\"}]"})
    EXPECT_NE(json.find(field), std::string::npos) << field << "\n" << json;
}

TEST(Report, KeepThatHangsOnNothingIsCounted) {
  VoxelSet target(8);
  for (int k = 0; k < 3; ++k) target.insert({1, 1, k});
  for (int i = 4; i < 7; ++i) target.insert({i, 5, 5});
  target.insert({2, 2, 3});  // touches the post along an edge only
  const ScratchFile file;
  const Report report = run_job(make_job(shipped_cell_files("gantry"), target), file.path(), {}).report;
  EXPECT_EQ(report.voxels.keep, 7u);
  EXPECT_EQ(report.voxels.loose_keep, 4u);
  EXPECT_EQ(report.voxels.loose_keep_pieces, 2u);
}

TEST(Report, ResidueIsALineAVoxel) {
  EXPECT_EQ(residue_ndjson({{{1, 2, 3}, Reason::enclosed}, {{4, 5, 6}, Reason::no_transit}}),
            "{\"voxel\":[1,2,3],\"reason\":\"enclosed\"}\n{\"voxel\":[4,5,6],\"reason\":\"no transit\"}\n");
}

}  // namespace
}  // namespace sculpt
