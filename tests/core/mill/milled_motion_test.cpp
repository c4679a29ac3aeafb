// A plan with milling tools, timed and as programs: the cutter stays off the part and nothing else touches, by brute
// force; the checker, which shares nothing with the time law, says the same and finds what was planted.
#include <gtest/gtest.h>

#include <sstream>

#include "core/cell/milling/mounted_tool.hpp"
#include "core/collision/scene.hpp"
#include "core/material/binvox.hpp"
#include "core/plan/intake.hpp"
#include "core/program/make_program.hpp"
#include "core/program/seams.hpp"
#include "core/timing/motion/sampler.hpp"
#include "core/timing/timed_plan.hpp"
#include "core/trajectory/reader.hpp"
#include "core/trajectory/writer.hpp"
#include "core/verify/timed/check_motion.hpp"
#include "tests/core/mill/milled_plan.hpp"

namespace sculpt {
namespace {

struct Timed {
  Job job;
  std::string text;
  Cell cell;
  PlanPath path;
  TimedPlan plan;

  LawFile law() const {
    LawFile file{plan.law, {}};
    std::istringstream in(text);
    TrajectoryReader reader(in);
    while (const auto keyframe = reader.next()) file.plan.add(keyframe->q);
    return file;
  }
};

std::string plan_text(Job& job) {
  job.mill->tolerance_m = 5e-4;  // quickly planned
  job.threads = 2;
  const std::filesystem::path file = milled::scratch("timed.ndjson");
  run_job(job, file, {});
  std::string text = milled::read(file);
  std::filesystem::remove(file);
  return text;
}

PlanPath path_of(const std::string& text) {
  std::istringstream in(text);
  return PlanPath(in);
}

const Timed& timed() {
  static const Timed made = [] {
    Job job = milled::make_job("bust", 16, {"D12", "D6"});
    std::string text = plan_text(job);
    Cell cell = parse_cell(job.cell);
    PlanPath path = path_of(text);
    TimedPlan plan = time_plan(path, cell, {0.1, 0.5, {}, 0});
    return Timed{std::move(job), std::move(text), std::move(cell), std::move(path), std::move(plan)};
  }();
  return made;
}

double distance_to_triangle(const Vec3& point, const std::array<Vec3, 3>& corner) {
  const Vec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  double least = std::numeric_limits<double>::infinity();
  bool inside = normal.norm() > 0;
  for (std::size_t at = 0; at < 3; ++at) {
    const Vec3 &a = corner[at], &b = corner[(at + 1) % 3], way = b - a;
    const double share = way.squaredNorm() > 0 ? std::clamp((point - a).dot(way) / way.squaredNorm(), 0.0, 1.0) : 0;
    least = std::min(least, (point - a - share * way).norm());
    inside = inside && way.cross(point - a).dot(normal) >= 0;
  }
  return inside ? std::abs((point - corner[0]).dot(normal.normalized())) : least;
}

double distance_to(const Mesh& part, const Vec3& point, double enough_m) {
  double least = enough_m;
  for (const auto& triangle : part.triangles) {
    const std::array<Vec3, 3> corner{part.vertices[triangle[0]], part.vertices[triangle[1]],
                                     part.vertices[triangle[2]]};
    const Vec3 low = corner[0].cwiseMin(corner[1]).cwiseMin(corner[2]),
               high = corner[0].cwiseMax(corner[1]).cwiseMax(corner[2]);
    if ((point - point.cwiseMax(low).cwiseMin(high)).norm() >= least) continue;
    least = std::min(least, distance_to_triangle(point, corner));
  }
  return least;
}

std::string said(const MotionVerdict& verdict) {
  std::string all;
  for (const MotionFinding& finding : verdict.findings)
    all += std::to_string(finding.keyframe) + ": " + finding.sentence + "\n";
  return all;
}

MotionVerdict check(const std::string& text, const LawFile& law) {
  std::istringstream in(text);
  return check_motion(in, law, timed().cell, {});
}

TEST(MilledMotion, CutsNothingThatIsToStay) {
  const Timed& one = timed();
  CheckedJob checked = check_job(one.job, {});
  const Mesh part = checked.shapes.place_part(checked.grid, {});
  MotionSampler sampler(one.path, one.plan.law);
  std::vector<Cell> cells;
  for (const MillTool& tool : one.path.header().mill->tools) {
    cells.push_back(carrying(one.cell, tool));
    // Without the cutter, which is a cylinder there down to its tip, and may touch.
    std::vector<Shape>& shapes = cells.back().robot.links[static_cast<std::size_t>(one.cell.tool_link)].shapes;
    shapes.erase(shapes.end() - static_cast<std::ptrdiff_t>(tool_shapes(tool).size()));
  }
  std::vector<std::unique_ptr<Scene>> rooms;  // nothing stands: links and tool against the room and themselves
  for (const Cell& cell : cells) rooms.push_back(std::make_unique<Scene>(cell, checked.grid, VoxelSet(16)));
  std::size_t samples = 0, near = 0;
  std::vector<std::size_t> with_tool(cells.size());
  for (double time = 0; time < sampler.duration_s(); time += 0.02, ++samples) {
    const Configuration q = sampler.at(time).q;
    const PlanPath::Edge& edge = one.path.edge_to(std::min(sampler.point_at(time) + 1, one.path.size() - 1));
    const double radius_m = one.path.header().mill->tools[edge.tool].cutter.radius_m;
    ++with_tool[edge.tool];
    const ToolPose pose = rooms[edge.tool]->chain().tool_pose(q);
    const double off_m = distance_to(part, pose.ball_m + radius_m * pose.axis, radius_m + 1e-4);
    ASSERT_GE(off_m, radius_m - 1e-6) << time;
    near += off_m < radius_m + 1e-4;
    if (samples % 16 == 0) {
      ASSERT_EQ(rooms[edge.tool]->contact_at(q), Contact::none) << time;
    }
  }
  EXPECT_GT(near, samples / 100);
  for (const std::size_t count : with_tool) EXPECT_GT(count, 100U);
}

TEST(MilledMotion, TheCheckerAgreesAndFindsWhatWasPlanted) {
  const Timed& one = timed();
  const LawFile law = one.law();
  const MotionVerdict verdict = check(one.text, law);
  EXPECT_EQ(verdict.faults, 0U) << said(verdict);
  EXPECT_GT(verdict.cutter_m, 1e-6);
  EXPECT_LE(verdict.cutter_m, one.path.header().mill->stray_m);
  EXPECT_LE(verdict.feed_m_s, 0.08 * (1 + 1e-6)) << "D12 takes no more, though 0.1 were asked for";

  const auto with = [&](const std::function<void(TrajectoryHeader&)>& change) {
    std::istringstream in(one.text);
    TrajectoryReader reader(in);
    TrajectoryHeader header = reader.header();
    change(header);
    std::ostringstream out;
    TrajectoryWriter writer(out, header);
    while (const auto keyframe = reader.next()) writer.add(*keyframe);
    writer.finish();
    return out.str();
  };
  EXPECT_GT(check(with([](TrajectoryHeader& header) { header.mill->stray_m /= 100; }), law).faults, 0U);
  EXPECT_GT(check(with([](TrajectoryHeader& header) { header.mill->tools[0].stickout_m += 1e-4; }), law).faults, 0U);
  EXPECT_GT(check(with([](TrajectoryHeader& header) { header.mill->tools[0].feed_m_s /= 2; }), law).faults, 0U);
  LawFile restless = law;
  std::istringstream in(one.text);
  TrajectoryReader reader(in);
  for (std::size_t at = 0; const auto keyframe = reader.next(); ++at)
    if (keyframe->mill->is_change()) restless.law.corners[at - 1] = {1e-6F, 1, 1e-6F, 1e-6F, 1e-6F};
  const MotionVerdict found = check(one.text, restless);
  EXPECT_NE(said(found).find("the tool is changed while the robot moves"), std::string::npos) << said(found);
}

TEST(MilledMotion, PartsEndWhereTheToolIsFree) {
  const Timed& one = timed();
  CheckedJob checked = check_job(one.job, {});
  const Mesh part = checked.shapes.place_part(checked.grid, {});
  const PathTools tools(one.path, one.cell, 0);
  constexpr std::size_t moves = 200;
  std::size_t begin = 0, returning = 0, climbs = 0;
  const std::vector<Seam> seams = find_seams(one.path, one.cell, tools, {moves, false});
  EXPECT_GT(seams.size(), one.path.size() / moves);
  for (const Seam& seam : seams) {
    EXPECT_LE(returning + seam.point - begin + seam.retreat.size(), moves);
    begin = seam.point;
    returning = seam.retreat.size();
    if (seam.retreat.empty()) {
      const bool is_change = one.path.edge_to(seam.point).rest;
      EXPECT_TRUE(is_change || (!one.path.edge_to(seam.point).cut && !one.path.edge_to(seam.point + 1).cut));
      continue;
    }
    const PathTool& tool = tools.on_edge_to(one.path, seam.point);
    const double radius_m = one.path.header().mill->tools[one.path.edge_to(seam.point).tool].cutter.radius_m;
    Configuration from = one.path.configuration(seam.point);
    for (const Configuration& to : seam.retreat) {
      for (double share = 0; share <= 1; share += 0.1) {
        const ToolPose pose = tool.chain.tool_pose(from + share * (to - from));
        ASSERT_GE(distance_to(part, pose.ball_m + radius_m * pose.axis, radius_m), radius_m - 1e-6);
      }
      from = to;
    }
    ++climbs;
  }
  EXPECT_GT(climbs, 3U);
}

TEST(MilledMotion, ProgramsStopForEachTool) {
  const Timed& one = timed();
  for (const Dialect dialect : {Dialect::krl, Dialect::rapid, Dialect::ros2}) {
    ProgramDemands demands;
    demands.dialect = dialect;
    demands.name = "bust";
    demands.motion = {0.1, 0.5, {}, 0};
    demands.stock_files = dialect != Dialect::ros2;
    std::vector<ProgramFile> mounting;
    std::vector<std::size_t> cut;  // voxels, before each part: the stock was the whole cube
    const ProgramReport report = make_program(one.path, one.cell, demands, [&](const ProgramFile& file) {
      if (file.text.find("MOUNT TOOL ") != std::string::npos) mounting.push_back(file);
      if (file.name.ends_with(".binvox")) cut.push_back(16 * 16 * 16 - read_binvox(file.text).size());
      const std::string before = "VOXELS CUT BEFORE ";
      if (const std::size_t at = file.text.find(before); at != file.text.npos) {
        EXPECT_EQ(std::stoul(file.text.substr(at + before.size())), cut.back()) << file.name;
      }
    });
    EXPECT_EQ(cut.size(), demands.stock_files ? report.parts : 0);
    ASSERT_EQ(mounting.size(), 2U) << facts_of(dialect).name;
    EXPECT_NE(mounting[0].text.find("MOUNT TOOL 2 D12"), std::string::npos);
    EXPECT_NE(mounting[1].text.find("MOUNT TOOL 3 D6"), std::string::npos);
    EXPECT_GT(report.moves, 1000U);
    EXPECT_LT(report.rounding_m, 1e-6);
  }
}

}  // namespace
}  // namespace sculpt
