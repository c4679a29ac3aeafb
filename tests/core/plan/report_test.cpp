#include <gtest/gtest.h>

#include "core/plan/plan.hpp"

namespace sculpt {
namespace {

TEST(Report, IsOneLineWithTheFieldsThatChecksRelyOn) {
  Report report;
  report.mesh = "a \"quoted\" name\xff.stl";
  report.residue = {{Reason::tool_cannot_reach, 3}};
  const std::string json = report_json(report);
  EXPECT_EQ(json.find('\n'), std::string::npos);
  for (const char* field : {"\"mesh\":",
                            "\"robot\":",
                            "\"search\":",
                            "\"seed\":",
                            "\"resolution\":",
                            "\"voxels\":{\"total\":",
                            "\"removed\":",
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
                            "\"peak_memory_bytes\":",
                            "\"threads\":",
                            "\"plan_sha256\":",
                            "\"verify\":{\"clean\":false",
                            "\"collisions\":",
                            "\"voxels_checked\":"})
    EXPECT_NE(json.find(field), std::string::npos) << field << "\n" << json;
}

TEST(Report, ResidueIsALineAVoxel) {
  EXPECT_EQ(residue_ndjson({{{1, 2, 3}, Reason::enclosed}, {{4, 5, 6}, Reason::no_transit}}),
            "{\"voxel\":[1,2,3],\"reason\":\"enclosed\"}\n{\"voxel\":[4,5,6],\"reason\":\"no transit\"}\n");
}

}  // namespace
}  // namespace sculpt
