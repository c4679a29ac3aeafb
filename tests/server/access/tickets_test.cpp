#include "server/access/tickets.hpp"

#include <gtest/gtest.h>

#include "proto/error_codes.hpp"

namespace sculpt::server {
namespace {

std::string redeemed(const Tickets& tickets, const std::string& ticket, Tickets::Clock::time_point now) {
  try {
    return tickets.redeem(ticket, now).artifact;
  } catch (const proto::ProtocolError& error) {
    return error.code();
  }
}

TEST(Tickets, EachIsForItsFileForFiveMinutes) {
  Tickets tickets;
  const Tickets::Clock::time_point start{};
  const std::string plan = tickets.issue("JOB", "trajectory", "csv", start);
  const std::string report = tickets.issue("JOB", "report", "", start + std::chrono::minutes(1));
  EXPECT_EQ(plan.size(), 64u);
  EXPECT_NE(plan, report);
  EXPECT_EQ(redeemed(tickets, plan, start + std::chrono::seconds(299)), "trajectory");
  EXPECT_EQ(redeemed(tickets, plan, start + std::chrono::seconds(299)), "trajectory") << "again";
  EXPECT_EQ(tickets.redeem(plan, start).format, "csv");
  EXPECT_EQ(redeemed(tickets, plan, start + std::chrono::minutes(5)), "gone");
  EXPECT_EQ(redeemed(tickets, report, start + std::chrono::minutes(5)), "report");
}

TEST(Tickets, WhatWasNeverIssuedIsGone) {
  Tickets tickets;
  const std::string ticket = tickets.issue("JOB", "report", "", {});
  EXPECT_EQ(redeemed(tickets, "", {}), "gone");
  EXPECT_EQ(redeemed(tickets, ticket.substr(1), {}), "gone");
  EXPECT_EQ(redeemed(tickets, ticket + "0", {}), "gone");
}

TEST(Tickets, OfVeryManyTheOldestGo) {
  Tickets tickets;
  const std::string first = tickets.issue("JOB", "report", "", {});
  std::string last;
  for (int i = 0; i < 10000; ++i) last = tickets.issue("JOB", "report", "", {});
  EXPECT_EQ(redeemed(tickets, first, {}), "gone");
  EXPECT_EQ(redeemed(tickets, last, {}), "report");
}

}  // namespace
}  // namespace sculpt::server
