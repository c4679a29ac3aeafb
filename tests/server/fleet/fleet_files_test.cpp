// Files in the database, where a fleet has no folder in common.
#include "server/fleet/fleet_files.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/base/random.hpp"
#include "core/base/sha256.hpp"
#include "server/files/blobs.hpp"
#include "server/files/job_files.hpp"
#include "tests/server/fleet/fleet_store_fixture.hpp"

namespace sculpt::server {
namespace {

constexpr std::chrono::seconds at_once{-1};

class FleetFilesTest : public FleetStoreTest {
 protected:
  void SetUp() override {
    FleetStoreTest::SetUp();
    if (IsSkipped()) return;
    files.emplace(PostgresSource{test_database(file), {}});
    others.emplace(PostgresSource{test_database(file), {}});
  }
  static std::string bytes(std::size_t count, std::uint64_t seed) {
    Random random(seed);
    std::string made(count, '\0');
    for (char& byte : made) byte = static_cast<char>(random.next());
    return made;
  }
  static std::string content(const std::filesystem::path& of) {
    std::ifstream in(of, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::string running_job() {
    const std::string job = add(*first);
    first->claim();
    return job;
  }

  std::optional<FleetFiles> files, others;
};

TEST_F(FleetFilesTest, WhatIsAppendedIsReadFromAnyPlaceByAnyDaemon) {
  const std::string job = running_job(), path = "jobs/" + job + "/1/trajectory.ndjson";
  ASSERT_TRUE(files->make(job, 1, path));
  ASSERT_TRUE(files->make(job, 1, path)) << "again";
  std::string all;
  for (std::size_t piece = 0; piece < 20; ++piece) {
    const std::string more = bytes(1 + piece * 977 % 5000, piece);
    files->append(path, all.size(), more);
    all += more;
  }
  EXPECT_EQ(others->size(path), all.size());
  EXPECT_EQ(others->read(path, 0, all.size() + 10), all);
  for (std::size_t offset = 0; offset <= all.size() + 3; offset += 331)
    ASSERT_EQ(others->read(path, offset, 2000), offset > all.size() ? "" : all.substr(offset, 2000)) << offset;
  EXPECT_THROW(files->append(path, all.size() - 1, "x"), StorageError) << "it ends elsewhere";
  EXPECT_EQ(others->files_of(job), (std::map<std::string, std::uint64_t>{{path, all.size()}}));
  EXPECT_EQ(others->bytes_of_jobs(), (std::map<std::string, std::uint64_t>{{job, all.size()}}));
}

TEST_F(FleetFilesTest, ACheckpointIsReplacedAsAWhole) {
  const std::string job = running_job(), path = "jobs/" + job + "/1/checkpoint-0";
  ASSERT_TRUE(files->make(job, 1, path));
  for (const std::size_t size : {10u, 3'000'000u, 5u}) {
    const std::string whole = bytes(size, size);
    files->replace(path, whole);
    EXPECT_EQ(others->size(path), whole.size());
    ASSERT_TRUE(download(*others, path, folder.path() / "copy"));
    EXPECT_EQ(content(folder.path() / "copy"), whole);
  }
}

TEST_F(FleetFilesTest, ARunThatLostItsJobMakesNoFiles) {
  const std::string job = running_job();
  end_all_leases();
  second->wake_due();
  ASSERT_EQ(second->claim()->attempt, 2);
  EXPECT_FALSE(files->make(job, 1, "jobs/" + job + "/1/trajectory.ndjson"));
  EXPECT_TRUE(others->make(job, 2, "jobs/" + job + "/2/trajectory.ndjson"));
}

TEST_F(FleetFilesTest, TheFilesOfARemovedJobGo) {
  const std::string job = running_job(), path = "jobs/" + job + "/1/report.json";
  ASSERT_TRUE(files->make(job, 1, path));
  files->append(path, 0, "{}");
  ASSERT_TRUE(first->finish(job, 1, success));
  files->remove_unused({}, std::chrono::hours(1));
  EXPECT_TRUE(files->size(path));
  ASSERT_TRUE(first->remove(job));
  files->remove_unused({}, std::chrono::hours(1));
  EXPECT_FALSE(files->size(path));
  EXPECT_EQ(other->ask({"SELECT count(*) FROM sculptd.piece"}).number(0, 0), 0);
}

TEST_F(FleetFilesTest, ABlobOfOneDaemonIsUsedByAnother) {
  Blobs here{folder.path() / "here", 10'000'000, &*files}, there{folder.path() / "there", 10'000'000, &*others};
  for (const char* name : {"here", "there"}) std::filesystem::create_directories(folder.path() / name);
  const std::string mesh = bytes(2'500'000, 1), hash = sha256_hex(mesh), half = mesh.substr(0, 1'000'000);
  EXPECT_FALSE(there.use(hash).complete);
  EXPECT_EQ(here.put(hash, mesh.size(), 0, half).have, half.size());
  EXPECT_FALSE(there.use(hash).complete) << "half of it is nothing to the others";
  EXPECT_TRUE(here.put(hash, mesh.size(), half.size(), mesh.substr(half.size())).complete);
  EXPECT_TRUE(there.use(hash).complete);
  EXPECT_EQ(there.read(hash, ""), mesh);
  EXPECT_EQ(there.add(mesh), hash);
  files->remove_unused({shared_blob(hash)}, at_once);
  EXPECT_TRUE(files->use(shared_blob(hash))) << "a job needs it";
  files->remove_unused({}, at_once);
  EXPECT_FALSE(files->use(shared_blob(hash)));
  EXPECT_TRUE(there.use(hash).complete) << "who has it shares it again";
  EXPECT_TRUE(files->use(shared_blob(hash)));
}

TEST_F(FleetFilesTest, OneBlobUploadedByTwoIsThereOnce) {
  const std::string mesh = bytes(3'000'000, 2), hash = sha256_hex(mesh);
  {
    const auto add_as = [&](const char* name, FleetFiles& with) {
      std::filesystem::create_directories(folder.path() / name);
      Blobs(folder.path() / name, 10'000'000, &with).add(mesh);
    };
    std::jthread one([&] { add_as("one", *files); }), two([&] { add_as("two", *others); });
  }
  EXPECT_EQ(files->size(shared_blob(hash)), mesh.size());
  EXPECT_EQ(other->ask({"SELECT count(*) FROM sculptd.file"}).number(0, 0), 1);
}

TEST_F(FleetFilesTest, ACopyIsMadeOnceAndDroppedWhenItIsOld) {
  const std::string job = running_job(), name = "trajectory.ndjson", job_folder = job + "/1";
  ASSERT_TRUE(files->make(job, 1, shared_path(job_folder, name)));
  files->append(shared_path(job_folder, name), 0, "lines");
  const JobFiles mine(folder.path() / "jobs", &*others);
  EXPECT_EQ(mine.open(job_folder, name)->read(1, 3), "ine");
  EXPECT_FALSE(mine.open(job_folder, "report.json"));
  mine.fetch(job_folder, name);
  EXPECT_EQ(content(mine.folder() / job_folder / name), "lines");
  EXPECT_EQ(mine.sizes()(job), 5u);
  mine.drop_copies(job, std::chrono::hours(1));
  EXPECT_TRUE(std::filesystem::exists(mine.folder() / job));
  mine.drop_copies(job, at_once);
  EXPECT_FALSE(std::filesystem::exists(mine.folder() / job));
  EXPECT_TRUE(mine.open(job_folder, name)) << "the shared one stays";
}

}  // namespace
}  // namespace sculpt::server
