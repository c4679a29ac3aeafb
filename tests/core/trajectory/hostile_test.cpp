// What a reader may be handed: cut short, changed, or never a trajectory. Always an InputError with the line, never
// anything else.
#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/base/sha256.hpp"
#include "core/trajectory/header.hpp"
#include "core/trajectory/reader.hpp"
#include "tests/core/trajectory/random_trajectory.hpp"

namespace sculpt {
namespace {

// Empty if the text was read to its end, else the sentence of the refusal.
std::string read_all(const std::string& text) {
  std::istringstream in(text);
  try {
    TrajectoryReader reader(in);
    while (reader.next()) {
    }
    return "";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), "trajectory_invalid");
    return error.what();
  }
}

// `body` with the end line that fits it.
std::string with_end(const std::string& body, int keyframes, int removed) {
  return body + R"({"type":"end","keyframes":)" + std::to_string(keyframes) + R"(,"removed":)" +
         std::to_string(removed) + R"(,"sha256":")" + sha256_hex(body) + "\"}\n";
}

const std::string good_header =
    R"({"type":"header","format":1,"joints":["x","y"],"home":[0,0],"resolution":8,"voxel_m":0.01,"origin_m":[0,0,0],)"
    R"("tool":{"ball_radius_m":0.0045,"shank_radius_m":0.004,"stickout_m":0.2},"tolerance_m":0.0002,"cell":"c","search":"octree","seed":7})";

std::string with_line(const std::string& line, int removed = 1) {
  return with_end(good_header + "\n" + line + "\n", 1, removed);
}

TEST(HostileTrajectory, TheUnchangedTextIsFine) {
  EXPECT_EQ(read_all(with_end(good_header + "\n", 0, 0)), "");
  EXPECT_EQ(read_all(with_line(R"({"type":"cut","q":[0,1],"voxels":[[0,0,0],[0,0,0]]})")), "");
  EXPECT_EQ(read_all(with_line(R"({"type":"move","q":[0,1]})", 0)), "");
}

TEST(HostileTrajectory, LinesThatAreNoKeyframesAreRefusedWithTheirNumber) {
  for (const std::string line : {R"()",
                                 R"(null)",
                                 R"([])",
                                 R"("move")",
                                 R"({})",
                                 R"({"type":"move"})",
                                 R"({"type":"jump","q":[0,1]})",
                                 R"({"type":7,"q":[0,1]})",
                                 R"({"type":"move","q":[0]})",
                                 R"({"type":"move","q":[0,1,2]})",
                                 R"({"type":"move","q":"01"})",
                                 R"({"type":"move","q":[0,"1"]})",
                                 R"({"type":"move","q":[0,null]})",
                                 R"({"type":"move","q":[0,NaN]})",
                                 R"({"type":"move","q":[0,Infinity]})",
                                 R"({"type":"move","q":[0,1e999]})",
                                 R"({"type":"move","q":[0,[1]]})",
                                 R"({"type":"move","q":[0,1]}})",
                                 R"({"type":"move","q":[0,1])",
                                 R"({"type":"cut","q":[0,1]})",
                                 R"({"type":"cut","q":[0,1],"voxels":[]})",
                                 R"({"type":"cut","q":[0,1],"voxels":[[0,0,0]]})",
                                 R"({"type":"cut","q":[0,1],"voxels":[[0,0,0],[0,0,0],[0,0,0]]})",
                                 R"({"type":"cut","q":[0,1],"voxels":[[0,0],[0,0]]})",
                                 R"({"type":"cut","q":[0,1],"voxels":[[0,0,8],[0,0,8]]})",
                                 R"({"type":"cut","q":[0,1],"voxels":[[0,0,-1],[0,0,0]]})",
                                 R"({"type":"cut","q":[0,1],"voxels":[[0,0,0.5],[0,0,1]]})",
                                 R"({"type":"cut","q":[0,1],"voxels":[[0,0,4294967296],[0,0,0]]})",
                                 R"({"type":"cut","q":[0,1],"voxels":[[0,0,99999999999999999999],[0,0,0]]})",
                                 R"({"type":"cut","q":[0,1],"voxels":[[0,0,0],[1,1,0]]})",
                                 R"({"type":"cut","q":[0,1],"voxels":[[0,1,0],[0,0,7]]})",
                                 R"({"type":"cut","q":[0,1],"voxels":{"a":1,"b":2}})",
                                 "\xff\xfe\x00garbage",
                                 "{\"type\":\"move\",\"q\":[0,1],\"\xff\":0}"}) {
    const std::string sentence = read_all(with_line(line));
    EXPECT_NE(sentence.find("trajectory line 2"), std::string::npos) << line << " -> " << sentence;
  }
}

TEST(HostileTrajectory, HeadersThatMakeNoSenseAreRefused) {
  const std::vector<std::pair<std::string, std::string>> changes = {{R"("type":"header")", R"("type":"move")"},
                                                                    {R"("format":1)", R"("format":2)"},
                                                                    {R"("format":1)", R"("format":"1")"},
                                                                    {R"(["x","y"])", R"([])"},
                                                                    {R"(["x","y"])", R"(["x","x"])"},
                                                                    {R"(["x","y"])", R"(["x",1])"},
                                                                    {R"(["x","y"])", R"({})"},
                                                                    {R"("home":[0,0])", R"("home":[0])"},
                                                                    {R"("home":[0,0])", R"("home":[0,1e400])"},
                                                                    {R"("resolution":8)", R"("resolution":0)"},
                                                                    {R"("resolution":8)", R"("resolution":-8)"},
                                                                    {R"("resolution":8)", R"("resolution":1e9)"},
                                                                    {R"("resolution":8)", R"("resolution":4294967304)"},
                                                                    {R"("voxel_m":0.01)", R"("voxel_m":0)"},
                                                                    {R"("voxel_m":0.01)", R"("voxel_m":-1)"},
                                                                    {R"("voxel_m":0.01)", R"("voxel_m":true)"},
                                                                    {R"("origin_m":[0,0,0])", R"("origin_m":[0,0])"},
                                                                    {R"("stickout_m":0.2)", R"("stickout_m":-0.2)"},
                                                                    {R"("tolerance_m":0.0002)", R"("tolerance_m":-1)"},
                                                                    {R"("cell":"c")", R"("cell":1)"},
                                                                    {R"("seed":7)", R"("seed":-7)"},
                                                                    {R"(,"seed":7)", ""},
                                                                    {R"("tool":{)", R"("tool":7,"t":{)"}};
  for (const auto& [from, to] : changes) {
    std::string header = good_header;
    ASSERT_NE(header.find(from), std::string::npos) << from;
    header.replace(header.find(from), from.size(), to);
    EXPECT_NE(read_all(with_end(header + "\n", 0, 0)).find("trajectory line 1"), std::string::npos) << to;
  }
}

TEST(HostileTrajectory, DeepNestingIsRefusedBeforeItIsParsed) {
  for (const char* bracket : {"[", "{\"a\":"}) {
    std::string line;
    for (int depth = 0; depth < 100000; ++depth) line += bracket;
    EXPECT_NE(read_all(with_line(line)).find("nested"), std::string::npos);
  }
}

TEST(HostileTrajectory, LinesWithoutEndAreRefused) {
  EXPECT_NE(read_all(good_header + "\n" + std::string(3 << 20, ' ')).find("line 2"), std::string::npos);
  EXPECT_NE(read_all(std::string(3 << 20, 'x')).find("line 1"), std::string::npos);
}

TEST(HostileTrajectory, WrongCountsHashesAndTextAfterTheEndAreRefused) {
  const std::string body = good_header + "\n" + R"({"type":"move","q":[0,1]})" + "\n";
  EXPECT_EQ(read_all(with_end(body, 1, 0)), "");
  EXPECT_NE(read_all(with_end(body, 2, 0)), "");
  EXPECT_NE(read_all(with_end(body, 1, 1)), "");
  EXPECT_NE(read_all(with_end(body, 1, 0) + "\n"), "");
  EXPECT_NE(read_all(with_end(body, 1, 0) + body), "");
  std::string changed = with_end(body, 1, 0);
  changed.replace(changed.find("[0,1]"), 5, "[0,2]");
  EXPECT_NE(read_all(changed).find("hash"), std::string::npos);
}

TEST(HostileTrajectory, EveryTruncationIsNoticed) {
  const TrajectoryHeader header = sample_header();
  const std::string text = write_text(header, {{Configuration::Constant(3, 0.5), false, {}, {}},
                                               {Configuration::Constant(3, 0.25), true, {1, 1, 1}, {1, 1, 3}}});
  // The very last byte is the newline after a complete end line: it alone may be missing.
  for (std::size_t size = 0; size + 1 < text.size(); ++size)
    EXPECT_NE(read_all(text.substr(0, size)), "") << size << " bytes";
}

TEST(HostileTrajectory, RandomDamageNeverGetsThroughUnnoticed) {
  const TrajectoryHeader header = sample_header();
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const std::string whole = write_text(header, {random_keyframe(random, header), random_keyframe(random, header)});
    std::string text = whole;
    for (std::uint64_t count = 1 + random.next() % 3; count > 0; --count) {
      const std::size_t at = random.next() % (text.size() - 1);
      switch (random.next() % 3) {
        case 0:
          text[at] = static_cast<char>(random.next());
          break;
        case 1:
          text.erase(at, 1 + random.next() % 5);
          break;
        default:
          text.insert(at, 1, static_cast<char>(random.next()));
          break;
      }
    }
    EXPECT_EQ(read_all(text).empty(), text == whole) << text;
  }
}

TEST(HostileTrajectory, BytesThatWereNeverATrajectoryAreRefused) {
  EXPECT_NE(read_all(""), "");
  EXPECT_NE(read_all("\n\n\n"), "");
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    std::string text(random.next() % 4000, '\0');
    for (char& byte : text) byte = static_cast<char>(random.next());
    EXPECT_NE(read_all(text), "");
  }
}

}  // namespace
}  // namespace sculpt
