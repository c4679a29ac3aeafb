// A stock whose neck the first pass from above would cut while a piece still hangs from it.
//
//   from the side, k up, 32 voxels of 1.6 mm:
//
//        +---------------+
//        |       neck    |   the target is a post within the left part; from above, all of the neck is in the first
//        |     +---------+   level
//        |post |  |piece |
//        |     |  |      |
//        |     |  +------+
//        |     |    prop     there in one of two stocks only
//   -----+-----+--------------
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "core/material/binvox.hpp"
#include "tests/core/material/shapes.hpp"
#include "tests/core/mill/milled_plan.hpp"

namespace sculpt {
namespace {

namespace fs = std::filesystem;

constexpr int n = 32;

MeshFile stock(bool propped) {
  VoxelSet voxels(n);
  shapes::fill(voxels, {12, 12, 0}, {19, 19, 26});
  shapes::fill(voxels, {20, 12, 25}, {31, 19, 26});
  shapes::fill(voxels, {24, 12, 10}, {31, 19, 24});
  if (propped) shapes::fill(voxels, {24, 12, 0}, {31, 19, 9});
  return {write_binvox(voxels, {n, 0.05 / n, Vec3::Zero()}), "binvox", "stock.binvox"};
}

Job make_post(bool propped) {
  Job job = milled::make_job("bust", n, {"D12"});
  job.mesh = {shapes::binary_stl(shapes::box(Vec3::Zero(), Vec3(10, 10, 38))), "stl", "post.stl"};
  job.placement.scale_m = 1e-3;
  job.stock.mesh = stock(propped);
  job.threads = 2;
  return job;
}

std::string plan(const Job& job, Report& report) {
  const fs::path file = milled::scratch("post.ndjson");
  report = run_job(job, file, {}).report;
  std::string text = milled::read(file);
  fs::remove(file);
  return text;
}

std::size_t loose_pieces(const Verdict& verdict) {
  return static_cast<std::size_t>(std::ranges::count_if(verdict.findings, [](const Finding& finding) {
    return finding.sentence.find("more than a chip, comes loose") != std::string::npos;
  }));
}

TEST(FreedPieces, AreMilledBeforeWhatHoldsThem) {
  Report report;
  plan(make_post(false), report);
  for (const std::string& finding : report.findings) std::cout << finding << "\n";
  EXPECT_TRUE(report.verify.clean);
  EXPECT_EQ(report.voxels.freed, 0u);
  EXPECT_GT(report.voxels.removed, report.voxels.remove * 17 / 20);  // what hangs is two fifths of it
}

TEST(FreedPieces, AreFoundByTheReplay) {
  Report report;
  const std::string text = plan(make_post(true), report);
  EXPECT_TRUE(report.verify.clean);
  std::istringstream as_planned(text), without_prop(text);
  EXPECT_EQ(loose_pieces(replay_plan(as_planned, make_post(true), {}, {})), 0u);
  const Verdict verdict = replay_plan(without_prop, make_post(false), {}, {});
  EXPECT_FALSE(verdict.clean);
  EXPECT_GT(verdict.freed, 100u);
  EXPECT_GT(loose_pieces(verdict), 0u);
}

/// Once the arm left for home from where the way back to its hub was cut short, as it would have freed a piece.
TEST(FreedPieces, AWayBackThatWouldFreeOneIsGoneAnotherWay) {
  Job job = milled::make_job("vase", n, {"D20"});
  job.threads = 2;
  Report report;
  plan(job, report);
  for (const std::string& finding : report.findings) std::cout << finding << "\n";
  EXPECT_TRUE(report.verify.clean) << "plan " << report.plan_sha256;
  EXPECT_EQ(report.voxels.freed, 0u);
}

}  // namespace
}  // namespace sculpt
