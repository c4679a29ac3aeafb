#include "core/base/content_key.hpp"

#include <gtest/gtest.h>

#include <set>

namespace sculpt {
namespace {

template <typename... Values>
std::string key_of(const Values&... values) {
  ContentKey key;
  (key.add(values), ...);
  return key.hex();
}

TEST(ContentKey, TellsWhatWasAddedApart) {
  using Text = std::string_view;
  const std::set<std::string> keys{key_of(),
                                   key_of(Text("")),
                                   key_of(Text("a")),
                                   key_of(Text("ab"), Text("c")),
                                   key_of(Text("a"), Text("bc")),
                                   key_of(Text("abc")),
                                   key_of(std::uint64_t{1}),
                                   key_of(std::uint64_t{1}, std::uint64_t{0}),
                                   key_of(1.0),
                                   key_of(Vec3(1, 2, 3)),
                                   key_of(Vec3(1, 3, 2))};
  EXPECT_EQ(keys.size(), 11u);
  EXPECT_EQ(key_of(Text("a"), 2.0), key_of(Text("a"), 2.0));
}

TEST(ContentKey, TheProgramHasAHash) {
  EXPECT_EQ(program_hash().size(), 64u);
  EXPECT_EQ(program_hash(), program_hash());
}

}  // namespace
}  // namespace sculpt
