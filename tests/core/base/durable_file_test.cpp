#include "core/base/durable_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <iterator>

#include "core/base/error.hpp"

namespace sculpt {
namespace {

namespace fs = std::filesystem;

class DurableFile : public testing::Test {
 protected:
  DurableFile() {
    std::string pattern = (fs::temp_directory_path() / "sculpt-test-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~DurableFile() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(DurableFile, IsReplacedAsAWholeAndNothingElseIsLeft) {
  const fs::path file = folder_ / "file";
  for (const std::string bytes : {"a long first content", "short", ""}) {
    replace_file(file, bytes);
    std::ifstream in(file, std::ios::binary);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), bytes);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
  }
}

TEST_F(DurableFile, IsAsItWasAfterTheDiskBeganWithIt) {
  const fs::path file = folder_ / "file";
  std::ofstream(file) << "bytes";
  start_sync(file);
  sync_file(file);
  std::ifstream in(file, std::ios::binary);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), "bytes");
  start_sync(folder_ / "nowhere");
  EXPECT_FALSE(fs::exists(folder_ / "nowhere"));
}

TEST_F(DurableFile, ThatCannotBeWrittenIsNamed) {
  const fs::path nowhere = folder_ / "nowhere" / "file";
  for (const auto& write : {std::function<void()>([&] { replace_file(nowhere, "bytes"); }),
                            std::function<void()>([&] { sync_file(nowhere); })}) {
    try {
      write();
      FAIL();
    } catch (const InputError& error) {
      EXPECT_EQ(error.code(), "file_unwritable");
      EXPECT_NE(std::string(error.what()).find(nowhere.string()), std::string::npos) << error.what();
    }
  }
}

TEST_F(DurableFile, IsNotReplacedByWhatCannotTakeItsPlace) {
  fs::create_directories(folder_ / "file" / "in the way");
  EXPECT_THROW(replace_file(folder_ / "file", "bytes"), InputError);
  EXPECT_TRUE(fs::exists(folder_ / "file" / "in the way"));
}

}  // namespace
}  // namespace sculpt
