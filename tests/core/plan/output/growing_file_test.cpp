#include "core/plan/output/growing_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <thread>

#include "core/base/watch.hpp"
#include "tests/core/plan/jobs.hpp"

namespace sculpt {
namespace {

TEST(GrowingFile, IsReadWholeHoweverItGrows) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const ScratchFile scratch;
    GrowingFile file(scratch.path());
    std::string read;
    std::thread reader([&] { read.assign(std::istreambuf_iterator<char>(file.in()), {}); });
    Random random(seed);
    std::string written;
    std::ofstream out(scratch.path(), std::ios::binary);
    for (int part = 0; part < 30; ++part) {
      const std::string bytes(random.next() % (seed % 2 == 0 ? 20 : 200'000), static_cast<char>('a' + part % 26));
      out << bytes << std::flush;
      written += bytes;
      file.grow();
      if (part % 7 == 0) std::this_thread::yield();
    }
    EXPECT_FALSE(file.ended());
    file.end();
    EXPECT_TRUE(file.ended());
    reader.join();
    EXPECT_TRUE(read == written) << read.size() << " of " << written.size();
  }
}

// A run that goes on finds a file of more than it will keep.
TEST(GrowingFile, IsNotLookedAtBeforeItGrows) {
  const ScratchFile scratch;
  std::ofstream(scratch.path()) << "of an earlier run";
  GrowingFile file(scratch.path());
  std::string read;
  std::thread reader([&] { std::getline(file.in(), read); });
  for (int spin = 0; spin < 1000; ++spin) std::this_thread::yield();
  std::ofstream(scratch.path(), std::ios::trunc) << "new\n";
  file.grow();
  reader.join();
  EXPECT_EQ(read, "new");
}

TEST(GrowingFile, WhoeverWaitsStopsWhenItIsGivenUp) {
  const ScratchFile scratch;
  GrowingFile file(scratch.path());
  std::ofstream(scratch.path()) << "half a li" << std::flush;
  file.grow();
  std::thread reader([&] {
    std::string line;
    EXPECT_THROW(std::getline(file.in(), line), Cancelled);
  });
  file.give_up();
  reader.join();
}

TEST(GrowingFile, OfNothingIsEmpty) {
  GrowingFile file("/nowhere/at/all");
  file.grow();
  file.end();
  EXPECT_EQ(file.in().get(), std::char_traits<char>::eof());
}

}  // namespace
}  // namespace sculpt
