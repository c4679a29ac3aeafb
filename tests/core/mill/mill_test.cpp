#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/base/error.hpp"
#include "core/trajectory/reader.hpp"
#include "core/trajectory/writer.hpp"
#include "tests/core/mill/milled_plan.hpp"
#include "tests/core/mill/solids.hpp"

namespace sculpt {
namespace {

namespace fs = std::filesystem;

using milled::height_field;
using milled::lines_with_steps;
using milled::make_job;
using milled::make_job_of;
using milled::read;
using milled::scratch;

/// Planned once for all tests that only look at it.
struct Planned {
  Job job;
  JobResult result;
  std::string text;
};
const Planned& planned() {
  static const Planned planned = [] {
    Planned made{make_job("bust", 32, {"D12", "D6"}), {}, {}};
    const fs::path file = scratch("planned.ndjson");
    made.job.threads = 2;
    made.result = run_job(made.job, file, {});
    made.text = read(file);
    fs::remove(file);
    return made;
  }();
  return planned;
}

Verdict replay(const std::string& text, const Job& job) {
  std::istringstream in(text);
  return replay_plan(in, job, {}, {});
}

TEST(Mill, CarvesABustAndIsClean) {
  const Report& report = planned().result.report;
  for (const std::string& finding : report.findings) std::cout << finding << "\n";
  EXPECT_TRUE(report.verify.clean);
  EXPECT_EQ(report.voxels.removed + report.voxels.residue, report.voxels.remove);
  EXPECT_GT(report.voxels.removed, report.voxels.remove * 9 / 10);
  ASSERT_EQ(report.tools.size(), 2U);
  EXPECT_GT(report.tools[0].removed_m3, report.tools[1].removed_m3);
  for (const ToolFigures& tool : report.tools) {
    EXPECT_GT(tool.engagement.mean, 0);
    EXPECT_GT(tool.engagement.largest, tool.engagement.mean);
  }
  ASSERT_TRUE(report.surface);
  EXPECT_EQ(report.surface->gouged_points, 0U);
  const ExcessFigures& reachable = report.surface->reachable;
  EXPECT_GT(reachable.points, report.surface->all.points / 4);
  EXPECT_GT(reachable.within_tolerance, reachable.points * 95 / 100);
  EXPECT_LT(reachable.p50_m, 1e-4);
  double shares = 0;
  for (const Cure& cure : report.cures) shares += cure.share;
  EXPECT_NEAR(shares, report.voxels.residue > 0 ? 1 : 0, 1e-9);
}

TEST(Mill, GivesTheSameBytesAtAnyNumberOfThreads) {
  Job job = planned().job;
  job.threads = 1;
  const fs::path file = scratch("again.ndjson");
  run_job(job, file, {});
  EXPECT_EQ(read(file), planned().text);
  fs::remove(file);
}

/// A plan with one thing changed, its hash made anew.
std::string changed(const std::string& text, const std::function<void(TrajectoryHeader&)>& header,
                    const std::function<bool(std::size_t, Keyframe&)>& keep) {
  std::istringstream in(text);
  TrajectoryReader reader(in);
  TrajectoryHeader of = reader.header();
  header(of);
  std::ostringstream out;
  TrajectoryWriter writer(out, of);
  for (std::size_t at = 0; auto keyframe = reader.next(); ++at)
    if (keep(at, *keyframe)) writer.add(*keyframe);
  writer.finish();
  return out.str();
}

std::size_t find_keyframe(const std::function<bool(const Keyframe&)>& is_it, std::size_t from = 0) {
  std::istringstream in(planned().text);
  TrajectoryReader reader(in);
  for (std::size_t at = 0; auto keyframe = reader.next(); ++at)
    if (at >= from && is_it(*keyframe)) return at;
  return 0;
}

TEST(MillReplay, FindsFaults) {
  const std::string& text = planned().text;
  const auto same_header = [](TrajectoryHeader&) {};
  const auto all = [](std::size_t, Keyframe&) { return true; };
  ASSERT_TRUE(replay(changed(text, same_header, all), planned().job).clean);
  const std::size_t cut = find_keyframe([](const Keyframe& k) { return k.cut && k.mill->removed > 3; }, 500);
  const std::size_t change = find_keyframe([](const Keyframe& k) { return k.mill->is_change(); });
  ASSERT_GT(cut, 0U);
  ASSERT_GT(change, 0U);
  const auto expect_found = [&](const std::string& what, const std::string& broken) {
    const Verdict verdict = replay(broken, planned().job);
    EXPECT_FALSE(verdict.clean) << what;
    if (!verdict.findings.empty())
      std::cout << what << ": line " << verdict.findings[0].line << ": " << verdict.findings[0].sentence << "\n";
  };
  expect_found("a count off by one", changed(text, same_header, [&](std::size_t at, Keyframe& k) {
                 if (at == cut) ++k.mill->removed;
                 return true;
               }));
  expect_found("a tool change dropped",
               changed(text, same_header, [&](std::size_t at, Keyframe&) { return at != change; }));
  expect_found("a radius 0.05 mm larger", changed(
                                              text,
                                              [](TrajectoryHeader& header) {
                                                Cutter& cutter = header.mill->tools[0].cutter;
                                                cutter.radius_m += 5e-5;
                                                cutter.corner_radius_m += 5e-5;
                                              },
                                              all));
  expect_found("a bigger tool in place of another",
               changed(
                   text, [](TrajectoryHeader& header) { header.mill->tools[1] = header.mill->tools[0]; }, all));
  expect_found("a keyframe 0.05 mm beside", changed(text, same_header, [&](std::size_t at, Keyframe& k) {
                 if (at == cut) k.mill->tip[2] -= 500;
                 return true;
               }));
  expect_found("a joint a thousandth of a degree off", changed(text, same_header, [&](std::size_t at, Keyframe& k) {
                 if (at == cut) k.q[1] += 1.75e-5;
                 return true;
               }));
  expect_found("a cut left out", changed(text, same_header, [&](std::size_t at, Keyframe&) { return at != cut; }));
  expect_found("a holder as wide as the stock", changed(
                                                    text,
                                                    [](TrajectoryHeader& header) {
                                                      for (HolderSection& section : header.mill->tools[0].body)
                                                        section.radius_m = section.end_radius_m = 0.06;
                                                    },
                                                    all));
  expect_found("half the depth allowed",
               changed(
                   text, [](TrajectoryHeader& header) { header.mill->tools[0].max_depth_m /= 4; }, all));
}

TEST(MillReplay, AGougeIsFound) {
  // The same plan, of the same part turned a little.
  Job other = planned().job;
  other.placement.rotation_rad = Vec3(0, 0, 0.05);
  const Verdict verdict = replay(planned().text, other);
  EXPECT_FALSE(verdict.clean);
}

TEST(Mill, UprightWallsAreNotCut) {
  // A slot of 8 mm (a path of the D6 once lay just between two rows of cells, which nobody looked at); two pockets with
  // 1 mm between them, where a row over a floor once took too much at a time.
  const auto slot = [](double x, double) { return std::abs(x - 25) > 4 ? 50.0 : 20.0; };
  const auto pockets = [](double x, double y) {
    const bool inside = std::abs(y - 25) < 15 && (std::abs(x - 12.5) < 8 || std::abs(x - 30) < 8.5);
    return inside ? 30.0 : 50.0;
  };
  for (const auto& [name, bytes] :
       {std::pair{"slot", height_field(lines_with_steps(50, {21, 29}), slot)},
        std::pair{"pockets", height_field(lines_with_steps(50, {4.5, 20.5, 21.5, 38.5, 10, 40}), pockets)}}) {
    SCOPED_TRACE(name);
    const Job job = make_job_of(bytes, 64, {"D12", "D6"});
    const fs::path file = scratch(name);
    const JobResult result = run_job(job, file, {});
    fs::remove(file);
    for (const std::string& finding : result.report.findings) std::cout << finding << "\n";
    EXPECT_TRUE(result.report.verify.clean);
    EXPECT_EQ(result.report.surface->gouged_points, 0U);
    const ExcessFigures& reachable = result.report.surface->reachable;
    EXPECT_GT(reachable.within_tolerance, reachable.points * 8 / 10);
  }
}

TEST(Mill, AFlatCutterRoughsPocketsAndWhatIsFlat) {
  // A plate of 34 mm, between two levels, with a pocket that is open above only. Where two rows met nothing was swept
  // whole by one of them, and counted as standing for ever; the neck kept off it.
  const auto plate = [](double x, double y) { return std::abs(x - 25) < 15 && std::abs(y - 25) < 12 ? 20.0 : 34.0; };
  Job job = make_job_of(height_field(lines_with_steps(50, {10, 13, 37, 40}), plate), 32, {"D12"});
  milled::change_tool(job, "D12", R"({"cutter": {"kind": "flat"}})");
  const fs::path file = scratch("flat");
  const JobResult result = run_job(job, file, {});
  fs::remove(file);
  EXPECT_TRUE(result.report.verify.clean);
  EXPECT_EQ(result.report.surface->gouged_points, 0U);
  // All but the corners of the pocket.
  EXPECT_GT(result.report.tools[0].removed_m3, 0.94 * (50 * 50 * 16 + 30 * 24 * 14) * 1e-9);
}

TEST(Mill, RefusesWhatCannotBe) {
  const auto refusal = [](Job job) -> std::string {
    try {
      run_job(job, scratch("refused.ndjson"), {});
    } catch (const InputError& error) {
      return error.code() + ": " + error.what();
    }
    return {};
  };
  Job job = make_job("bust", 16, {"D12"});
  job.mill->tolerance_m = 0;
  EXPECT_NE(refusal(job).find("above 0"), std::string::npos);
  job.mill->tolerance_m = 0.02;
  EXPECT_NE(refusal(job).find("more than the radius"), std::string::npos);
  job.mill->tolerance_m = 1e-4;
  job.mill->scallop_m = 2e-4;
  EXPECT_NE(refusal(job).find("do not fit into the tolerance"), std::string::npos);
  job.mill->scallop_m.reset();
  job.mill->allowance_m = 1e-6;
  EXPECT_NE(refusal(job).find("less room to stray"), std::string::npos);
  job.mill->allowance_m.reset();
  job.mill->tools = {"D12", "D12"};
  EXPECT_NE(refusal(job).find("named twice"), std::string::npos);
  job.mill.reset();
  EXPECT_NE(refusal(job).find("needs tools"), std::string::npos);
  job = make_job("bust", 16, {"D12"});
  job.search = Search::sweep;
  EXPECT_NE(refusal(job).find("leave one of the two out"), std::string::npos);
  job = make_job("bust", 16, {"D12"});
  job.cell = read_cell_files(SOURCE_DIR "/config/cells/gantry.json");
  EXPECT_NE(refusal(job).find("only translates"), std::string::npos);
}

}  // namespace
}  // namespace sculpt
