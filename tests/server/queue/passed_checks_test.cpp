#include "server/queue/passed_checks.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "core/base/sha256.hpp"
#include "tests/server/temp_folder.hpp"

namespace sculpt::server {
namespace {

proto::JobSpec sample_spec() {
  proto::JobSpec spec;
  spec.mesh = {sha256_hex("mesh"), "part.stl"};
  spec.robot = "gantry";
  spec.resolution = 64;
  return spec;
}

const std::string bundle = sha256_hex("bundle");

TEST(CheckKey, ChangesWithAllThatACheckDependsOn) {
  const std::string key = check_key(sample_spec(), bundle, {});
  EXPECT_NE(check_key(sample_spec(), sha256_hex("another"), {}), key);
  EXPECT_NE(check_key(sample_spec(), bundle, {1, 1 << 20}), key);
  for (const auto& change : std::vector<std::function<void(proto::JobSpec&)>>{
           [](proto::JobSpec& other) { other.mesh.sha256 = sha256_hex("other"); },
           [](proto::JobSpec& other) { other.mesh.name = "part.ply"; },
           [](proto::JobSpec& other) { other.stock_mesh = other.mesh; },
           [](proto::JobSpec& other) { other.resolution = 32; }, [](proto::JobSpec& other) { other.search = "voxel"; },
           [](proto::JobSpec& other) { other.placement.margin_m = 0.01; },
           [](proto::JobSpec& other) {
             other.stock_box = proto::BoxSpec{{0, 0, 0}, {1, 1, 1}};
           }}) {
    proto::JobSpec other = sample_spec();
    change(other);
    EXPECT_NE(check_key(other, bundle, {}), key) << proto::write_json(to_json(other));
  }
}

TEST(CheckKey, IsTheSameForTheSameFilesUnderAnotherNameSeedAndNumberOfThreads) {
  proto::JobSpec other = sample_spec();
  other.mesh.name = "another part.STL";
  other.seed = 7;
  other.threads = 5;
  EXPECT_EQ(check_key(other, bundle, {}), check_key(sample_spec(), bundle, {}));
}

// Hashes and names were joined by blanks, and names may hold them: these two gave the same text.
TEST(CheckKey, ABenignMeshDoesNotVouchForAnEvilStock) {
  const std::string evil = sha256_hex("evil");
  proto::JobSpec benign = sample_spec(), other = sample_spec();
  benign.mesh.name = "x.stl " + evil + " y.stl";
  other.mesh.name = "x.stl";
  other.stock_mesh = proto::BlobRef{evil, "y.stl "};
  EXPECT_NE(check_key(benign, bundle, {}), check_key(other, bundle, {}));
}

TEST(PassedChecks, AreKeptForEver) {
  const TempFolder folder;
  const std::filesystem::path file = folder.path() / "checked";
  const std::string first = sha256_hex("first"), second = sha256_hex("second"), third = sha256_hex("third");
  {
    PassedChecks passed(file);
    EXPECT_FALSE(passed.has(first));
    passed.add(first);
    passed.add(second);
    EXPECT_TRUE(passed.has(first));
  }
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 20);  // a crash while it was written
  {
    PassedChecks passed(file);
    EXPECT_TRUE(passed.has(first));
    EXPECT_FALSE(passed.has(second));
    passed.add(third);
  }
  EXPECT_TRUE(PassedChecks(file).has(first));
  EXPECT_TRUE(PassedChecks(file).has(third));
}

TEST(PassedChecks, WhereTheFileCannotBeWrittenAreKnownUntilTheEnd) {
  PassedChecks passed("/nowhere/checked");
  passed.add("key");
  EXPECT_TRUE(passed.has("key"));
}

}  // namespace
}  // namespace sculpt::server
