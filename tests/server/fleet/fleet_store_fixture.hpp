// Several daemons over one database of the test.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <string>
#include <thread>

#include "server/fleet/postgres.hpp"
#include "tests/server/temp_folder.hpp"
#include "tests/server/test_store.hpp"

namespace sculpt::server {

inline const Ending success{JobState::succeeded, {}, {}, {{"trajectory", "ndjson", 12, "abc"}}, Cause::job};

class FleetStoreTest : public testing::Test {
 protected:
  void SetUp() override {
    SCULPT_POSTGRES_ONLY();
    first = open("first");
    second = open("second");
    other.emplace(PostgresSource{test_database(file), {}}, std::chrono::seconds(30));
  }

  std::unique_ptr<FleetStore> open(const std::string& daemon, StoreRules rules = {},
                                   std::chrono::milliseconds lease = std::chrono::seconds(30)) {
    return open_test_fleet(file, std::move(rules), daemon, lease);
  }
  static std::string add(FleetStore& store, const std::string& key = {}, std::uint64_t memory_bytes = 1) {
    NewJob job;
    job.key = key;
    job.spec = "{}";
    job.memory_bytes = memory_bytes;
    return store.submit(job).job.id;
  }
  void end_all_leases() { other->ask({"UPDATE sculptd.lease SET until = now() - interval '1 s'"}); }
  /// Until it is so: what hangs for ever is ended by the test's own limit.
  static void await(const std::function<bool()>& holds) {
    while (!holds()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  static FleetHooks quiet() {
    return {[](const std::string&, JobState) {}, [](const std::string&) {},
            [](const std::string&) { return std::optional<Progress>(); }};
  }

  TempFolder folder;
  std::filesystem::path file = folder.path() / "fleet";
  std::unique_ptr<FleetStore> first, second;
  std::optional<Postgres> other;
};

}  // namespace sculpt::server
