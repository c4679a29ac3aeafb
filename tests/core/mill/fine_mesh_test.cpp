// A part of two million triangles, as a scanner gives them.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/mill/milled_plan.hpp"
#include "tests/core/mill/solids.hpp"

namespace sculpt {
namespace {

constexpr double side_mm = 50;

double waves(double x, double y) {
  return 35 + 6 * std::sin(x / 6) * std::cos(y / 8) + 0.05 * std::sin(4 * x + 3 * y);
}

TEST(FineMesh, OfTwoMillionTrianglesIsMilled) {
  constexpr int squares = 710;
  Job job = milled::make_job_of(milled::height_field(side_mm, squares, waves), 32, {"D12"}, side_mm / 1000);
  job.mill->tolerance_m = 3e-4;
  job.threads = 2;
  const auto file = milled::scratch("fine.sct");
  const JobResult result = run_job(job, file, {});
  std::filesystem::remove(file);
  EXPECT_TRUE(result.report.verify.clean);
  ASSERT_TRUE(result.report.surface);
  EXPECT_EQ(result.report.surface->gouged_points, 0u);
}

}  // namespace
}  // namespace sculpt
