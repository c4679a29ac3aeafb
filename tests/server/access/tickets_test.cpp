#include "server/access/tickets.hpp"

#include <gtest/gtest.h>

#include "proto/error_codes.hpp"

namespace sculpt::server {
namespace {

constexpr std::uint64_t start_ms = 1'700'000'000'000, minute_ms = 60'000;

class TicketsTest : public testing::Test {
 protected:
  static std::string redeemed(const Tickets& by, const std::string& ticket) {
    try {
      return by.redeem(ticket).artifact;
    } catch (const proto::ProtocolError& error) {
      return error.code();
    }
  }

  std::uint64_t now_ms = start_ms;
  Tickets tickets{"secret", [this] { return now_ms; }}, of_another_daemon{"secret", [this] { return now_ms; }},
      stranger{"another", [this] { return now_ms; }};
};

TEST_F(TicketsTest, EachIsForItsFileForFiveMinutes) {
  const std::string plan = tickets.issue({"JOB", "trajectory", "csv", 0, 0});
  now_ms += minute_ms;
  const std::string report = tickets.issue({"JOB", "report", "", 0, 0});
  now_ms = start_ms + 5 * minute_ms - 1;
  EXPECT_EQ(redeemed(tickets, plan), "trajectory");
  EXPECT_EQ(redeemed(tickets, plan), "trajectory") << "again";
  EXPECT_EQ(tickets.redeem(plan).format, "csv");
  EXPECT_EQ(tickets.redeem(plan).job, "JOB");
  now_ms = start_ms + 5 * minute_ms;
  EXPECT_EQ(redeemed(tickets, plan), "gone");
  EXPECT_EQ(redeemed(tickets, report), "report");
}

TEST_F(TicketsTest, OneForAProgramSaysWhichProgram) {
  proto::ArtifactReadParams wanted{"JOB", "program", "", 0, 0};
  wanted.program = {"krl", "bust", {0.05, 0.5, {}}, 5000, {}, false, true};
  const std::string ticket = tickets.issue(wanted);
  EXPECT_EQ(ticket.find_first_not_of("0123456789abcdefghijklmnopqrstuvwxyzJOB."), std::string::npos);
  const auto redeemed = tickets.redeem(ticket);
  EXPECT_EQ(redeemed.artifact, "program");
  EXPECT_EQ(to_json(redeemed.program.value()), to_json(*wanted.program));
}

TEST_F(TicketsTest, AnotherDaemonWithTheSameSecretTakesThem) {
  const std::string ticket = tickets.issue({"JOB", "report", "", 0, 0});
  EXPECT_EQ(redeemed(of_another_daemon, ticket), "report");
  EXPECT_EQ(redeemed(stranger, ticket), "gone");
}

TEST_F(TicketsTest, WhatWasNeverIssuedIsGone) {
  const std::string ticket = tickets.issue({"JOB", "report", "", 0, 0});
  for (const std::string& wrong : {std::string(), std::string("."), std::string("...."), ticket.substr(1), ticket + "0",
                                   ticket.substr(0, ticket.rfind('.'))})
    EXPECT_EQ(redeemed(tickets, wrong), "gone") << wrong;
  for (std::size_t i = 0; i < ticket.size(); ++i) {
    std::string wrong = ticket;
    wrong[i] = wrong[i] == '1' ? '2' : '1';
    EXPECT_EQ(redeemed(tickets, wrong), "gone") << wrong;
  }
}

}  // namespace
}  // namespace sculpt::server
