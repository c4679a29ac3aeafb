#include "core/plan/output/batch_writer.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <future>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

/// Keyframes that say which they are.
std::vector<Keyframe> numbered(std::size_t first, std::size_t count) {
  std::vector<Keyframe> batch(count);
  for (std::size_t at = 0; at < count; ++at) batch[at].q = Configuration::Constant(1, static_cast<double>(first + at));
  return batch;
}

TEST(BatchWriter, WritesEverythingOnceAndInOrder) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    std::size_t written = 0, added = 0, wrong = 0;
    {
      BatchWriter writer([&](const std::vector<Keyframe>& batch) {
        for (const Keyframe& keyframe : batch) wrong += keyframe.q[0] != static_cast<double>(written++);
      });
      for (int at = 0; at < 50; ++at) {
        const std::size_t count = random.next() % (seed % 2 == 0 ? 10 : 20000);
        writer.add(numbered(added, count));
        added += count;
        if (random.next() % 8 == 0) {
          writer.wait();
          EXPECT_EQ(written, added);
        }
      }
      if (seed % 3 > 0) writer.finish();
    }
    EXPECT_EQ(written, added);
    EXPECT_EQ(wrong, 0u);
  }
}

TEST(BatchWriter, HoldsBackWhileTooMuchWaits) {
  std::promise<void> allow;
  std::shared_future<void> allowed = allow.get_future().share();
  BatchWriter writer([allowed](const std::vector<Keyframe>&) { allowed.wait(); });
  constexpr std::size_t third = BatchWriter::max_waiting / 3 + 1;
  std::atomic<int> added = 0;
  std::thread adder([&] {
    for (int at = 0; at < 12; ++at) {
      writer.add(numbered(0, third));
      ++added;
    }
  });
  // One may be in the writer's hands, three wait.
  for (int spin = 0; spin < 1000; ++spin) std::this_thread::yield();
  EXPECT_LE(added, 4);
  allow.set_value();
  adder.join();
  EXPECT_EQ(added, 12);
}

TEST(BatchWriter, WhatWritingThrowsIsThrownToWhoeverAddsOrFinishes) {
  for (std::size_t failing : {0u, 1u, 7u}) {
    SCOPED_TRACE("batch " + std::to_string(failing));
    std::size_t calls = 0;
    const auto write = [&](const std::vector<Keyframe>&) {
      if (calls++ == failing) throw std::runtime_error("the disk is full");
    };
    const auto add_all = [&] {
      BatchWriter writer(write);
      for (int at = 0; at < 8; ++at) writer.add(numbered(0, 1000));
      writer.finish();
    };
    EXPECT_THROW(add_all(), std::runtime_error);
    EXPECT_EQ(calls, failing + 1) << "nothing is written behind what failed";
  }
}

TEST(BatchWriter, AFailureEndsTheWaitOfWhoeverIsHeldBack) {
  BatchWriter writer([](const std::vector<Keyframe>&) { throw std::runtime_error("the disk is full"); });
  EXPECT_THROW(for (;;) writer.add(numbered(0, BatchWriter::max_waiting / 2)), std::runtime_error);
}

}  // namespace
}  // namespace sculpt
