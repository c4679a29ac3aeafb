#include <gtest/gtest.h>

#include <sstream>

#include "core/base/error.hpp"
#include "core/base/random.hpp"
#include "core/trajectory/export.hpp"
#include "core/trajectory/quantum.hpp"
#include "core/trajectory/reader.hpp"
#include "core/trajectory/writer.hpp"
#include "tests/core/trajectory/random_trajectory.hpp"

namespace sculpt {
namespace {

TrajectoryHeader mill_header() {
  TrajectoryHeader header = sample_header();
  MillTool ball{
      "D20", 1, {CutterKind::ball, 0.01, 0.01, 0.06}, {{0.06, 0.01, 0.01}, {0.08, 0.031, 0.04}}, 0.2, 0.01, 0.01, 0.1,
      {},    {}};
  MillTool bull{"a \"bull\"", 7,   {CutterKind::bull, 0.01, 0.002, 0.03}, {{0.1, 0.01, 0.01}}, 0.13, 0.01, 0.01, 0.1,
                0.02,         8000};
  header.mill = MillHeader{{ball, bull}, {{0, 0, 1}, {26, 0, -15}}, 2e-5, std::string(64, 'a')};
  return header;
}

Keyframe random_step(Random& random, std::size_t joints) {
  Keyframe keyframe;
  keyframe.q.resize(static_cast<Eigen::Index>(joints));
  for (double& value : keyframe.q)
    value = from_quanta(static_cast<std::int64_t>(random.next() % 40'000'000) - 20'000'000);
  MillStep& step = keyframe.mill.emplace();
  const auto kind = random.next() % 8;
  if (kind == 0) return keyframe;
  if (kind == 1) {
    step.tool = static_cast<int>(random.next() % 2);
    return keyframe;
  }
  step.direction = static_cast<int>(random.next() % 2);
  for (auto& value : step.tip) value = static_cast<std::int64_t>(random.next() % 8'000'000) - 4'000'000;
  keyframe.cut = kind > 3;
  if (keyframe.cut) step.removed = static_cast<std::uint32_t>(random.next() % 300);
  return keyframe;
}

std::string make_plan(std::uint64_t seed, int count) {
  std::ostringstream out;
  const TrajectoryHeader header = mill_header();
  TrajectoryWriter writer(out, header);
  Random random(seed);
  for (int n = 0; n < count; ++n) writer.add(random_step(random, header.joints.size()));
  writer.finish();
  return out.str();
}

TEST(MillLine, AllFormsHoldTheSame) {
  for (const auto& [seed, count] : {std::pair{1, 0}, {2, 1}, {3, 4096}, {4, 9000}}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::string text = make_plan(static_cast<std::uint64_t>(seed), count);
    std::istringstream in(text);
    std::stringstream sct;
    export_binary(in, sct);
    std::ostringstream back;
    export_text(sct, back);
    EXPECT_EQ(back.str(), text);
    std::istringstream again(text);
    std::ostringstream csv;
    export_csv(again, csv);
    EXPECT_EQ(std::ranges::count(csv.str(), '\n'), count + 4);
  }
}

TEST(MillLine, TheHeaderComesBackAsItWas) {
  std::istringstream in(make_plan(1, 3));
  const TrajectoryHeader header = TrajectoryReader(in).header();
  ASSERT_TRUE(header.mill);
  const MillHeader expected = *mill_header().mill;
  ASSERT_EQ(header.mill->tools.size(), 2U);
  EXPECT_EQ(header.mill->tools[1].name, expected.tools[1].name);
  EXPECT_EQ(header.mill->tools[1].cutter.corner_radius_m, 0.002);
  EXPECT_EQ(header.mill->tools[0].body[1].end_radius_m, 0.04);
  EXPECT_EQ(header.mill->directions, expected.directions);
  EXPECT_EQ(header.mill->stray_m, 2e-5);
  EXPECT_EQ(header.mill->mesh_sha256, expected.mesh_sha256);
}

TEST(MillLine, RefusesWhatIsNotOfTheHeader) {
  const std::string text = make_plan(5, 0), header = text.substr(0, text.find('\n') + 1);
  const std::size_t joints = mill_header().joints.size();
  std::string q = "[0";
  for (std::size_t at = 1; at < joints; ++at) q += ",0";
  q += "]";
  for (const std::string& line : std::initializer_list<std::string>{
           R"({"type":"cut","q":)" + q + "}",
           R"({"type":"cut","q":)" + q + R"(,"direction":2,"tip":[0,0,0],"removed":1})",
           R"({"type":"cut","q":)" + q + R"(,"direction":0,"tip":[0,0,0]})",
           R"({"type":"cut","q":)" + q + R"(,"direction":0,"tip":[0,0,11],"removed":1})",
           R"({"type":"cut","q":)" + q + R"(,"direction":0,"tip":[0,0,1e-8],"removed":1})",
           R"({"type":"cut","q":)" + q + R"(,"direction":0,"tip":[0,0,0],"removed":-1})",
           R"({"type":"cut","q":)" + q + R"(,"direction":0,"tip":[0,0],"removed":1})",
           R"({"type":"tool","tool":"D21","q":)" + q + "}",
           R"({"type":"cut","q":)" + q + R"(,"voxels":[[0,0,0],[0,0,0]]})"}) {
    std::istringstream in(header + line + "\n");
    EXPECT_THROW(
        {
          TrajectoryReader reader(in);
          reader.next();
        },
        InputError)
        << line;
  }
}

TEST(MillLine, NoCutOfTheBytesIsTakenForAWholePlan) {
  const std::string text = make_plan(6, 60);
  std::istringstream in(text);
  std::ostringstream sct;
  export_binary(in, sct);
  for (const std::string& whole : {text, sct.str()})
    for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 200) {
      std::istringstream part(whole.substr(0, size));
      EXPECT_THROW(
          {
            TrajectoryReader reader(part);
            while (reader.next()) {
            }
          },
          InputError)
          << size;
    }
}

}  // namespace
}  // namespace sculpt
