#include "core/timing/motion/held_pieces.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.hpp"
#include "core/timing/motion/sample_table.hpp"
#include "core/timing/motion/sampler.hpp"
#include "core/timing/timed_plan.hpp"
#include "tests/core/timing/made_up_paths.hpp"

namespace sculpt {
namespace {

struct TimedWander {
  Cell cell;
  PlanPath path;
  TimeLaw law;
};

TimedWander make(const char* name, std::uint64_t seed, std::size_t keyframes) {
  Cell cell = shipped_cell(name);
  Random random(seed);
  PlanPath path = path_of(cell, wander(cell, random, keyframes));
  TimeLaw law = time_plan(path, cell, {0.05, 0.5, {}, 0}).law;
  return {std::move(cell), std::move(path), std::move(law)};
}

/// No gap, no jump, and no acceleration over the law's at either end of a piece: so nowhere. Gives the end.
double expect_limits_kept(HeldPieces& pieces, const TimedWander& made) {
  MotionPiece piece;
  double end_s = 0;
  Configuration at = made.path.configuration(0), velocity = Configuration::Zero(at.size());
  while (pieces.next(piece)) {
    EXPECT_NEAR(piece.begin_s, end_s, 1e-9);
    EXPECT_LE((piece.q(0) - at).cwiseAbs().maxCoeff(), 1e-9) << "at " << end_s;
    EXPECT_LE((piece.velocity(0) - velocity).cwiseAbs().maxCoeff(), 1e-5) << "at " << end_s;
    for (const double t : {0.0, piece.seconds}) {
      const double s = (piece.speed + piece.rise * t / 2) * t, speed = piece.speed + piece.rise * t;
      const Configuration acceleration = (piece.way + piece.bend * s) * piece.rise + piece.bend * (speed * speed);
      for (Eigen::Index j = 0; j < at.size(); ++j)
        EXPECT_LE(std::abs(acceleration[j]), 1.0001 * made.law.acceleration[static_cast<std::size_t>(j)])
            << "joint " << j << " at " << piece.begin_s + t;
    }
    at = piece.q(piece.seconds);
    velocity = piece.velocity(piece.seconds);
    end_s = piece.end_s();
  }
  EXPECT_LE((made.path.configuration(made.path.size() - 1) - at).cwiseAbs().maxCoeff(), 1e-9);
  return end_s;
}

/// Times of pieces are rounded: behind a hold one may begin a little later than the one before it ends.
TEST(HeldPieces, ASampleBetweenTwoPiecesIsAsThoseBesideIt) {
  Random random(6);
  int between = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const TimedWander made = make("panda-turntable", seed, 150);
    for (int round = 0; round < 40; ++round) {
      HeldPieces pieces(made.path, made.law);
      MotionSampler sampler(made.path, made.law);
      const std::vector<double> holds{random.between(0.1, 0.9) * pieces.end_s()};
      pieces.hold(holds);
      sampler.hold(holds);
      MotionPiece piece;
      double end_s = 0;
      while (pieces.next(piece)) {
        const double time_s = end_s + (piece.begin_s - end_s) / 2;
        if (time_s > end_s && time_s < piece.begin_s) {
          ++between;
          const MotionSample before = sampler.at(time_s - 1e-6), there = sampler.at(time_s);
          EXPECT_LE((there.velocity - before.velocity).cwiseAbs().maxCoeff(), 1e-3)
              << "seed " << seed << ", round " << round << ", " << time_s;
          EXPECT_LE((there.q - before.q).cwiseAbs().maxCoeff(), 1e-5);
        }
        end_s = piece.end_s();
      }
    }
  }
  EXPECT_GT(between, 0);
}

TEST(HeldPieces, AHoldAnywhereKeepsTheLimitsAndRests) {
  for (const char* name : {"panda-turntable", "gantry"}) {
    const TimedWander made = make(name, 3, 150);
    HeldPieces pieces(made.path, made.law);
    const double end_s = pieces.end_s();
    EXPECT_NEAR(expect_limits_kept(pieces, made), end_s, 1e-9);
    Random random(4);
    for (int round = 0; round < 60; ++round) {
      const double begin_s = random.between(0, end_s);
      SCOPED_TRACE(std::string(name) + " held at " + std::to_string(begin_s));
      pieces.hold({begin_s});
      EXPECT_NEAR(expect_limits_kept(pieces, made), pieces.end_s(), 1e-9);
      ASSERT_EQ(pieces.holds().size(), 1u);
      const PathHold hold = pieces.holds().front();
      EXPECT_GE(hold.rest_s, begin_s + made.law.window_s * (1 - 1e-12));
      EXPECT_GE(pieces.end_s(), end_s);
      MotionSampler held(made.path, made.law), free(made.path, made.law);
      held.hold({begin_s});
      for (const double rest : {0.0, 0.5, 1.0})
        EXPECT_LE(held.at(hold.rest_s + rest * hold_rest_s).velocity.cwiseAbs().maxCoeff(), 1e-9);
      for (const double before : {0.0, 0.3, 0.9, 1.0})
        EXPECT_LE((held.at(before * begin_s).q - free.at(before * begin_s).q).cwiseAbs().maxCoeff(), 1e-12);
      // Once the law's speed is come to, it is the law, later.
      const double later = pieces.end_s() - end_s, last = 0.999 * end_s;
      if (hold.rest_s >= 0.9 * end_s) continue;
      EXPECT_LE((held.at(last + later).q - free.at(last).q).cwiseAbs().maxCoeff(), 1e-7);
    }
  }
}

TEST(HeldPieces, HoldsMayFollowOneAnotherWhileTheMotionStillRises) {
  const TimedWander made = make("panda-turntable", 8, 150);
  HeldPieces pieces(made.path, made.law);
  Random random(9);
  for (int round = 0; round < 30; ++round) {
    std::vector<double> begins;
    double from_s = random.between(0, 0.5 * pieces.end_s());
    for (int hold = 0; hold < 5; ++hold) {
      begins.push_back(from_s);
      pieces.hold(begins);
      from_s = pieces.holds().back().rest_s + std::pow(10, random.between(-4, 1));
    }
    SCOPED_TRACE("round " + std::to_string(round));
    EXPECT_NEAR(expect_limits_kept(pieces, made), pieces.end_s(), 1e-9);
    MotionSampler held(made.path, made.law);
    held.hold(begins);
    for (const PathHold& hold : held.holds()) EXPECT_LE(held.at(hold.rest_s).velocity.cwiseAbs().maxCoeff(), 1e-9);
    // Windows in any order are those of one go.
    MotionSampler other(made.path, made.law);
    other.hold(begins);
    for (int look = 0; look < 40; ++look) {
      const double time_s = random.between(0, held.duration_s());
      EXPECT_LE((other.at(time_s).q - held.at(time_s).q).cwiseAbs().maxCoeff(), 1e-10) << time_s;
      held.at(look * held.duration_s() / 40);
    }
    pieces.hold({});
  }
}

TEST(HeldPieces, AHoldThatCannotBeIsRefusedAndOneTooLateChangesNothing) {
  const TimedWander made = make("gantry", 5, 20);
  HeldPieces pieces(made.path, made.law);
  const double end_s = pieces.end_s();
  pieces.hold({end_s + 1});
  EXPECT_EQ(pieces.end_s(), end_s);
  EXPECT_EQ(pieces.holds().front().rest_s, end_s + made.law.window_s);
  try {
    pieces.hold({0.3 * end_s, 0.3 * end_s});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), "hold_invalid");
  }
}

TEST(SampleTable, ItsRowsAreTheSamplesAndTheLastStandsAtTheEnd) {
  const TimedWander made = make("gantry", 5, 20);
  MotionSampler sampler(made.path, made.law);
  const SampleRate rate{250};
  EXPECT_EQ(rate.first_from(0), 0u);
  EXPECT_EQ(rate.first_from(0.004), 1u);
  EXPECT_EQ(rate.first_from(0.0041), 2u);
  const std::uint64_t last = rate.last_of(sampler.duration_s());
  EXPECT_GE(rate.time_of(last), sampler.duration_s() - 1e-9);
  const std::string rows = sample_rows(sampler, rate, last - 9, 10);
  ASSERT_EQ(rows.size(), 10 * sample_row_bytes(made.path.dof()));
  const auto* values = reinterpret_cast<const double*>(rows.data());
  for (std::size_t j = 0; j < made.path.dof(); ++j) {
    const auto joint = static_cast<Eigen::Index>(j);
    EXPECT_EQ(values[j], sampler.at(rate.time_of(last - 9)).q[joint]);
    const double* end = values + 9 * 2 * made.path.dof();
    EXPECT_EQ(end[j], made.path.configuration(made.path.size() - 1)[joint]);
    EXPECT_EQ(end[made.path.dof() + j], 0);
  }
  EXPECT_TRUE(sample_rows(sampler, rate, 0, 0).empty());
}

}  // namespace
}  // namespace sculpt
