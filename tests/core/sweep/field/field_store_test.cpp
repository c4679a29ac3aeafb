#include "core/sweep/field/field_store.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "core/base/random.hpp"
#include "core/sweep/directions.hpp"
#include "tests/core/sweep/panda_field.hpp"

namespace sculpt {
namespace {

namespace fs = std::filesystem;

/// A folder that goes with the test.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (fs::temp_directory_path() / "sculpt-fields-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~ScratchFolder() { fs::remove_all(path_); }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  return files;
}

Directions find(const FieldStore& store) {
  const PandaField& panda = PandaField::get();
  static const Helpers helpers(1);
  static const Watch watch;
  Directions directions(panda.scene, panda.cell.home(panda.scene.chain()), {7, helpers, watch}, store);
  directions.find_straight_fields();
  return directions;
}

/// Every number of them at random places, and what they say of random edges.
void expect_same(Directions& a, Directions& b, std::uint64_t seed) {
  ASSERT_EQ(a.size(), b.size());
  Random random(seed);
  int usable = 0, free = 0;
  for (std::size_t way = 0; way < a.size(); ++way) {
    if (!a.is_straight(way)) continue;
    const PostureField &one = a.field(way), &other = b.field(way);
    ASSERT_EQ(one.usable_cells(), other.usable_cells());
    for (int trial = 0; trial < 300; ++trial) {
      const Vec3 from(random.between(0, 15), random.between(0, 15), random.between(0, 17)),
          to = (from + Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1))).cwiseMax(0);
      ASSERT_EQ(one.usable(from), other.usable(from));
      const auto q = one.at(from), p = other.at(from), q_to = one.at(to);
      ASSERT_EQ(q.has_value(), p.has_value());
      if (!q) continue;
      ++usable;
      ASSERT_EQ(*q, *p);
      if (!q_to) continue;
      int held = -1, held_other = -1;
      const bool is_free = one.links_are_free(from, *q, to, *q_to, held);
      ASSERT_EQ(is_free, other.links_are_free(from, *q, to, *q_to, held_other));
      ASSERT_EQ(held, held_other);
      ASSERT_EQ(one.allows_wide_path(from, to), other.allows_wide_path(from, to));
      free += is_free;
    }
  }
  EXPECT_GT(usable, 500);
  EXPECT_GT(free, 300);
}

TEST(FieldStore, GivesBackTheSameFields) {
  const ScratchFolder folder;
  const FieldStore store(folder.path() / "made when needed", "key");
  Directions without = find({}), first = find(store);
  const auto files = files_in(folder.path() / "made when needed");
  ASSERT_FALSE(files.empty());
  ASSERT_TRUE(store.read(0)) << "the first direction's";
  Directions again = find(store);
  EXPECT_EQ(files_in(folder.path() / "made when needed"), files);
  expect_same(without, first, 1);
  expect_same(without, again, 2);
}

TEST(FieldStore, KnowsNothingOfAnotherKey) {
  const ScratchFolder folder;
  find(FieldStore(folder.path(), "one"));
  EXPECT_TRUE(FieldStore(folder.path(), "one").read(0));
  EXPECT_FALSE(FieldStore(folder.path(), "other").read(0));
  EXPECT_FALSE(FieldStore(folder.path(), "one").read(1000));
  EXPECT_FALSE(FieldStore().read(0));
  EXPECT_TRUE(FieldStore(folder.path(), "one").has(0));
  EXPECT_FALSE(FieldStore(folder.path(), "other").has(0));
  EXPECT_FALSE(FieldStore().has(0));
}

TEST(FieldStore, TakesNothingThatIsDamaged) {
  const ScratchFolder folder;
  const FieldStore store(folder.path(), "key");
  find(store);
  const fs::path file = folder.path() / "key-0.fields";
  std::ifstream in(file, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  const auto put = [&](const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; };
  Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    std::string flipped = whole;
    const auto at = static_cast<std::size_t>(random.next() % whole.size());
    flipped[at] = static_cast<char>(flipped[at] ^ 1 << random.next() % 8);
    put(flipped);
    ASSERT_FALSE(store.read(0)) << "byte " << at;
    put(whole.substr(0, trial == 0 ? 0 : at));
    ASSERT_FALSE(store.read(0)) << "cut at " << at;
  }
  put(whole);
  EXPECT_TRUE(store.read(0));
}

TEST(FieldStore, ThatCannotBeWrittenKeepsNothing) {
  const ScratchFolder folder;
  std::ofstream(folder.path() / "file") << "no folder";
  const FieldStore store(folder.path() / "file", "key");
  Directions found = find(store), without = find({});
  EXPECT_FALSE(store.read(0));
  expect_same(without, found, 4);
}

TEST(FieldStore, DropsTheOldestWhenThereIsTooMuch) {
  const ScratchFolder folder;
  const fs::path old = folder.path() / "older-0.fields", other = folder.path() / "not-ours";
  std::ofstream{old};
  std::ofstream{other};
  fs::resize_file(old, 300u << 20);
  fs::last_write_time(old, fs::file_time_type::clock::now() - std::chrono::hours(1));
  find(FieldStore(folder.path(), "key"));
  EXPECT_FALSE(fs::exists(old));
  EXPECT_TRUE(fs::exists(other));
  EXPECT_TRUE(FieldStore(folder.path(), "key").read(0));
}

}  // namespace
}  // namespace sculpt
