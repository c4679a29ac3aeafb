// Arms as makers draw them, at random: standing and hanging, links thicker and thinner than their joints have room for.
// What `cell new` makes of them and calls ready is planned with and replays clean. SCULPT_MAKERS_ARMS=N tries N of
// them, from seed SCULPT_MAKERS_FROM on.
#include <gtest/gtest.h>

#include "core/base/helpers.hpp"
#include "core/base/run_context.hpp"
#include "core/doctor/examine.hpp"
#include "core/doctor/make/new_cell.hpp"
#include "tests/core/plan/jobs.hpp"
#include "tests/core/plan/soundness.hpp"

namespace sculpt {
namespace {

constexpr int resolution = 8;

std::string triple(const Vec3& v) {
  return std::to_string(v.x()) + " " + std::to_string(v.y()) + " " + std::to_string(v.z());
}

/// A bar from the link's origin along `to`, as thick as it comes.
std::string bar(const Vec3& to, Random& random) {
  const double length = to.norm(), radius = length * random.between(0.1, 0.45);
  const Vec3 axis = to / length;
  const Vec3 rpy(0, std::acos(axis.z()), std::atan2(axis.y(), axis.x()));
  return "<collision><origin xyz='" + triple(to / 2) + "' rpy='" + triple(rpy) + "'/><geometry><cylinder radius='" +
         std::to_string(radius) + "' length='" + std::to_string(length * random.between(0.5, 1.1)) +
         "'/></geometry></collision>";
}

/// Six joints: an industrial arm's, or those of an arm whose links stand beside each other.
std::string makers_arm(std::uint64_t seed) {
  Random random(seed);
  const double s = random.between(0.5, 2);
  const bool beside = random.unit() < 0.5, hangs = random.unit() < 0.3;
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  const auto part = [&](double low, double high) { return s * random.between(low, high); };
  const double w = part(0.06, 0.12);
  const std::vector<Vec3> axes = beside ? std::vector<Vec3>{z, y, y, y, z, y} : std::vector<Vec3>{z, y, y, x, y, x};
  const std::vector<Vec3> steps =
      beside ? std::vector<Vec3>{part(0.1, 0.2) * z,  w * y,       part(0.3, 0.5) * z - 0.9 * w * y,
                                 part(0.3, 0.45) * z, 0.9 * w * y, 0.8 * w * z,
                                 0.6 * w * y}
             : std::vector<Vec3>{part(0.15, 0.3) * z, part(0.01, 0.2) * x + part(0.15, 0.3) * z,
                                 part(0.3, 0.8) * z,  part(0.1, 0.3) * x + part(-0.05, 0.1) * z,
                                 part(0.2, 0.5) * x,  w * x,
                                 0.5 * w * x};
  std::string urdf =
      "<robot name='arm'><link name='world'/><link name='l0'>" + bar(steps[0], random) +
      "</link><joint name='mount' type='fixed'><parent link='world'/><child link='l0'/><origin xyz='0 0 " +
      std::to_string(hangs ? 2.5 * s : 0) + "' rpy='" + (hangs ? "3.14159265" : "0") + " 0 0'/></joint>";
  for (std::size_t at = 0; at < axes.size(); ++at) {
    const std::string above = std::to_string(at), here = std::to_string(at + 1);
    const double lower = -random.between(1.5, 3.1), upper = random.between(1.5, 3.1);
    urdf += "<link name='l" + here + "'>" + bar(steps[at + 1], random) + "</link><joint name='j" + here +
            "' type='revolute'><parent link='l" + above + "'/><child link='l" + here + "'/><origin xyz='" +
            triple(steps[at]) + "'/><axis xyz='" + triple(axes[at]) + "'/><limit lower='" + std::to_string(lower) +
            "' upper='" + std::to_string(upper) + "' velocity='2' effort='1'/></joint>";
  }
  return urdf +
         "<link name='tool0'/><joint name='flange' type='fixed'><parent link='l6'/><child link='tool0'/><origin xyz='" +
         triple(steps[6]) + "' rpy='" + (beside ? "-1.570796 0 0" : "0 1.570796 0") + "'/></joint></robot>";
}

TEST(MakersArms, WhatIsCalledReadyIsPlannedAndReplaysClean) {
  const std::uint64_t from = number_from("SCULPT_MAKERS_FROM", 1), count = number_from("SCULPT_MAKERS_ARMS", 12);
  int ready = 0;
  for (std::uint64_t seed = from; seed < from + count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Helpers helpers(2);
    const Watch watch{};
    const std::string urdf = makers_arm(seed);
    const NewCell made = make_cell({urdf, {}}, {}, {0, helpers, watch});
    CellFiles files;
    files.name = "arm";
    files.cell_json = cell_text(made.cell, "arm.urdf", {});
    files.files["arm.urdf"] = made.urdf;
    ExamineSettings quick;
    quick.resolution = resolution;
    quick.fields = false;
    const CellFindings found = examine_files(files, quick, {0, helpers, watch});
    const ScratchFile file;
    Job job = make_job(files, random_target(resolution, seed));
    job.threads = 2;
    if (!found.plannable()) continue;
    ++ready;
    const JobResult result = run_job(job, file.path(), {});
    expect_sound(result);
    for (const std::string& finding : result.report.findings) ADD_FAILURE() << finding << "\n" << urdf;
  }
  EXPECT_GE(2 * static_cast<std::uint64_t>(ready), count) << "most arms are of use";
}

}  // namespace
}  // namespace sculpt
