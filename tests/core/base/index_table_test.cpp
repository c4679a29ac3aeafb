#include "core/base/index_table.hpp"

#include <gtest/gtest.h>

#include <map>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

TEST(IndexTable, KeepsWhatAMapKeepsFromRoundToRound) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    IndexTable<std::uint8_t> table;
    for (int round = 0; round < 10; ++round) {
      table.clear();
      std::map<std::size_t, std::uint8_t> expected;
      const double count = random.between(1, 3000), range = random.between(1, 1e9);
      for (int step = 0; step < count; ++step) {
        const auto index = static_cast<std::size_t>(random.between(0, range));
        const auto byte = static_cast<std::uint8_t>(random.next() % 256);
        const auto [place, is_new] = expected.try_emplace(index, byte);
        const auto [kept, entered] = table.enter(index);
        ASSERT_EQ(entered, is_new);
        if (entered) {
          ASSERT_EQ(kept, 0);
          kept = byte;
        }
        ASSERT_EQ(kept, place->second);
        ASSERT_EQ(table.size(), expected.size());
      }
    }
  }
}

}  // namespace
}  // namespace sculpt
