#include "server/http/artifact_path.hpp"

#include <gtest/gtest.h>

#include "proto/error_codes.hpp"

namespace sculpt::server {
namespace {

std::string refusal(const char* path) {
  try {
    read_artifact_path(path);
    return "accepted";
  } catch (const proto::ProtocolError& error) {
    return error.code();
  }
}

TEST(ArtifactPath, SaysWhichArtifactInWhichForm) {
  const auto plain = read_artifact_path("JOB/voxels"), csv = read_artifact_path("JOB/trajectory?format=csv");
  EXPECT_EQ(plain.job + plain.artifact + plain.format, "JOBvoxels");
  EXPECT_EQ(csv.job + csv.artifact + csv.format, "JOBtrajectorycsv");
}

TEST(ArtifactPath, SaysWhichProgram) {
  const auto wanted = read_artifact_path(
      "JOB/program?dialect=krl&name=bust&feed_m_s=0.05&rapid_m_s=0.4&keep_feed=0.5&part_keyframes=100&part_bytes=9000"
      "&stock_files=true&seams_in_stock=true&format=zip");
  EXPECT_EQ(wanted.format, "zip");
  EXPECT_EQ(to_json(wanted.program.value()),
            (Json{{"dialect", "krl"},
                  {"name", "bust"},
                  {"motion", {{"feed_m_s", 0.05}, {"rapid_m_s", 0.4}, {"keep_feed", 0.5}}},
                  {"part_keyframes", 100},
                  {"part_bytes", 9000},
                  {"stock_files", true},
                  {"seams_in_stock", true}}));
}

TEST(ArtifactPath, WhatMeansNothingIsRefused) {
  EXPECT_EQ(refusal("JOB"), "not_found");
  EXPECT_EQ(refusal("JOB?format=csv"), "not_found");
  for (const char* path : {"/voxels", "JOB/", "JOB/voxels?form=csv", "JOB/voxels?format", "JOB/voxels?dialect=krl",
                           "JOB/program", "JOB/program?dialect=", "JOB/program?dialect=krl&feed_m_s=fast",
                           "JOB/program?dialect=krl&seams_in_stock=1", "JOB/program?dialect=krl&part_bytes=-1",
                           "JOB/program?dialect=krl&color=red", "JOB/program?dialect=krl&motion={}"})
    EXPECT_EQ(refusal(path), "params_invalid") << path;
}

}  // namespace
}  // namespace sculpt::server
