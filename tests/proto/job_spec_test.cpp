#include "proto/job_spec.hpp"

#include <gtest/gtest.h>

#include "proto/cell_bundle.hpp"
#include "proto/messages.hpp"

namespace sculpt::proto {
namespace {

const std::string hash(64, 'a');

Json plain_spec() {
  return {{"mesh", {{"blob", hash}, {"name", "a.stl"}}}, {"robot", "gantry"}, {"resolution", 16}};
}

JobSpec read(const Json& spec) {
  return read_job_spec(Fields(spec, "/params/spec"));
}

std::string pointer_of(const Json& spec) {
  try {
    read(spec);
    return "accepted";
  } catch (const ProtocolError& error) {
    EXPECT_EQ(error.code(), "params_invalid");
    return error.pointer();
  }
}

Json with(const std::string& pointer, const Json& value) {
  Json spec = plain_spec();
  spec[Json::json_pointer(pointer)] = value;
  return spec;
}

TEST(JobSpec, AFullSpecComesBackAsItWas) {
  const Json full = parse_json(
      R"({"mesh":{"blob":")" + hash + R"(","name":"a.stl"},"robot":{"cell":{"blob":")" + hash +
      R"("}},"resolution":64,"search":"octree","seed":18446744073709551615,"threads":2,)"
      R"("placement":{"scale_m":0.5,"rotation_rad":[0.0,1.0,2.0],"offset_m":[0.0,0.25,0.0],"margin_m":0.01},)"
      R"("stock":{"box":{"min_m":[0.0,0.0,0.0],"max_m":[1.0,1.0,0.5]}}})");
  EXPECT_EQ(write_json(to_json(read(full))), write_json(full));
  const Json mesh_stock = with("/stock", {{"mesh", {{"blob", hash}, {"name", "rest.binvox"}}}});
  EXPECT_EQ(write_json(to_json(read(mesh_stock))), write_json(mesh_stock));
  const Json next = with("/continue", {{"job", "j"}, {"rotation_rad", {0.5, 0.0, 0.0}}});
  EXPECT_EQ(write_json(to_json(read(next))), write_json(next));
  const Json timed = with("/motion", {{"feed_m_s", 0.05}, {"rapid_m_s", 0.25}, {"keep_feed", 0.5}});
  EXPECT_EQ(write_json(to_json(read(timed))), write_json(timed));
  const Json milled = with("/motion", Json::object());  // at the tools' own feed
  EXPECT_EQ(write_json(to_json(read(milled))), write_json(milled));
}

TEST(JobSpec, SpellingOutDefaultsOrAnotherOrderGivesTheSameText) {
  Json spelled{{"seed", 0}, {"resolution", 16}, {"placement", {{"margin_m", 0}}}};
  spelled.update(plain_spec());
  EXPECT_EQ(write_json(to_json(read(spelled))), write_json(to_json(read(plain_spec()))));
}

TEST(JobSpec, EveryFieldToBlameIsNamed) {
  EXPECT_EQ(pointer_of(plain_spec()), "accepted");
  EXPECT_EQ(pointer_of(Json::array()), "/params/spec");
  EXPECT_EQ(pointer_of(Json::object()), "/params/spec/mesh");
  EXPECT_EQ(pointer_of(with("/mesh", "a.stl")), "/params/spec/mesh");
  EXPECT_EQ(pointer_of(with("/motion", 0.05)), "/params/spec/motion");
  EXPECT_EQ(pointer_of(with("/motion", {{"feed_m_s", "fast"}})), "/params/spec/motion/feed_m_s");
  EXPECT_EQ(pointer_of(with("/motion", {{"rapid_m_s", true}})), "/params/spec/motion/rapid_m_s");
  EXPECT_EQ(pointer_of(with("/motion", {{"keep_feed", nullptr}})), "/params/spec/motion/keep_feed");
  EXPECT_EQ(pointer_of(with("/motion", {{"feed", 1}})), "/params/spec/motion/feed");
  EXPECT_EQ(pointer_of(with("/mesh/blob", "AA")), "/params/spec/mesh/blob");
  EXPECT_EQ(pointer_of(with("/mesh/nam", "x")), "/params/spec/mesh/nam");
  EXPECT_EQ(pointer_of(with("/resolution", 16.0)), "/params/spec/resolution");
  EXPECT_EQ(pointer_of(with("/resolution", "16")), "/params/spec/resolution");
  EXPECT_EQ(pointer_of(with("/resolution", 1e300)), "/params/spec/resolution");
  EXPECT_EQ(pointer_of(with("/resolution", 1ull << 40)), "/params/spec/resolution");
  EXPECT_EQ(pointer_of(with("/seed", -1)), "/params/spec/seed");
  EXPECT_EQ(pointer_of(with("/threads", 0)), "/params/spec/threads");
  EXPECT_EQ(pointer_of(with("/voxel_mm", 1)), "/params/spec/voxel_mm");
  EXPECT_EQ(pointer_of(with("/a~1b", 1)), "/params/spec/a~1b");
  EXPECT_EQ(pointer_of(with("/placement", {{"scale_m", 0}})), "/params/spec/placement/scale_m");
  EXPECT_EQ(pointer_of(with("/placement", {{"offset_m", {0, 0}}})), "/params/spec/placement/offset_m");
  EXPECT_EQ(pointer_of(with("/placement", {{"offset_m", {0, 0, "0"}}})), "/params/spec/placement/offset_m");
  EXPECT_EQ(pointer_of(with("/stock", Json::object())), "/params/spec/stock/box");
  EXPECT_EQ(pointer_of(with("/continue", Json::object())), "/params/spec/continue/job");
  EXPECT_EQ(pointer_of(with("/continue", {{"job", "j"}, {"rotation_rad", {0, 0}}})),
            "/params/spec/continue/rotation_rad");
  for (const char* field : {"placement", "stock"}) {
    Json beside = with("/continue", {{"job", "j"}});
    beside[field] = Json::object();
    EXPECT_NE(pointer_of(beside), "accepted") << field;
  }
  EXPECT_EQ(pointer_of(with("/stock", {{"box", {{"min_m", {0, 0, 0}}}}})), "/params/spec/stock/box/max_m");
}

TEST(JobSpec, ARobotIsANameAndNeverAPathOnTheServer) {
  for (const char* name : {"../gantry", "/etc/passwd", "a/b", ".hidden", "gantry.json", "a\\b", ""}) {
    EXPECT_EQ(pointer_of(with("/robot", name)), "/params/spec/robot") << name;
  }
  EXPECT_EQ(pointer_of(with("/robot", {{"cell", hash}})), "/params/spec/robot/cell");
  EXPECT_EQ(pointer_of(with("/robot", 7)), "/params/spec/robot");
}

TEST(CellBundle, ComesBackAsItWasAndIsAlwaysTheSameBytes) {
  const CellBundle bundle{"my-cell", "{\"urdf\": \"room.urdf\"}", {{"room.urdf", hash}, {"package://a/b.stl", hash}}};
  const std::string bytes = write_cell_bundle(bundle);
  const CellBundle back = read_cell_bundle(bytes);
  EXPECT_EQ(back.name, bundle.name);
  EXPECT_EQ(back.cell_json, bundle.cell_json);
  EXPECT_EQ(back.files, bundle.files);
  EXPECT_EQ(write_cell_bundle(back), bytes);
}

TEST(CellBundle, WhatIsNoBundleIsRefused) {
  for (const char* text :
       {"", "{}", "[]", "{\"name\":\"a\",\"cell\":\"b\",\"files\":[]}", "{\"name\":\"a\",\"cell\":{},\"files\":{}}",
        "{\"name\":\"a\",\"cell\":\"b\",\"files\":{\"x\":{\"blob\":\"y\"}}}",
        "{\"name\":\"a\",\"cell\":\"b\",\"files\":{},\"more\":1}"}) {
    EXPECT_THROW(read_cell_bundle(text), ProtocolError) << text;
  }
}

TEST(Messages, AChunkMayNotReachBeyondItsBlob) {
  const Json put{{"sha256", hash}, {"size", 10}, {"offset", 8}, {"bytes", 2}};
  EXPECT_EQ(read_blob_put(put).offset, 8u);
  for (const char* text :
       {R"("offset":8,"bytes":3)", R"("offset":11,"bytes":0)", R"("offset":18446744073709551615,"bytes":2)"}) {
    EXPECT_THROW(read_blob_put(parse_json(R"({"sha256":")" + hash + R"(","size":10,)" + text + "}")), ProtocolError)
        << text;
  }
}

TEST(Messages, MomentsAreUtcAndComeBackWithMilliseconds) {
  Json params{{"spec", plain_spec()}};
  const std::vector<std::pair<std::string, std::string>> moments{
      {"2028-02-29T23:59:59Z", "2028-02-29T23:59:59.000Z"}, {"2028-02-29T00:00:00.5Z", "2028-02-29T00:00:00.500Z"}};
  for (const auto& [given, kept] : moments) {
    params["not_before"] = given;
    EXPECT_EQ(read_submit(params).not_before, kept);
  }
  for (const char* wrong : {"2027-02-29T00:00:00Z", "2028-02-29T24:00:00Z", "2028-02-29T00:00:00",
                            "2028-13-01T00:00:00Z", "2028-02-29T00:00:00+01:00", "tomorrow", ""}) {
    params["not_before"] = wrong;
    EXPECT_THROW(read_submit(params), ProtocolError) << wrong;
  }
}

TEST(Messages, AJobThatCouldNeverStartIsRefused) {
  Json params{{"spec", plain_spec()}, {"not_before", "2028-02-29T00:00:00Z"}};
  params["start_by"] = "2028-02-29T00:00:00.001Z";
  EXPECT_EQ(read_submit(params).start_by, "2028-02-29T00:00:00.001Z");
  params["start_by"] = "2028-02-29T00:00:00Z";
  EXPECT_THROW(read_submit(params), ProtocolError);
  params["max_runtime_s"] = 0;
  EXPECT_THROW(read_submit(params), ProtocolError);
}

TEST(Messages, LimitsOfParamsAreKept) {
  EXPECT_THROW(read_hello({{"protocol", {1}}, {"client", "c"}}), ProtocolError);
  EXPECT_THROW(read_hello({{"protocol", {1, 0}}, {"client", "c"}, {"max_line", 255}}), ProtocolError);
  EXPECT_EQ(read_hello({{"protocol", {1, 0}}, {"client", "c"}, {"max_line", 256}}).max_line, 256u);
  EXPECT_THROW(read_list({{"limit", 0}}), ProtocolError);
  EXPECT_THROW(read_wait({{"job", "j"}, {"timeout_s", -1}}), ProtocolError);
  EXPECT_THROW(read_nothing({{"x", 1}}), ProtocolError);
}

}  // namespace
}  // namespace sculpt::proto
