#include "tests/server/test_store.hpp"

#include <unistd.h>

#include <cstdlib>
#include <map>

#include "server/fleet/postgres.hpp"

namespace sculpt::server {
namespace {

std::string server_url() {
  const char* url = std::getenv("SCULPT_TEST_POSTGRES");
  return url == nullptr ? "" : url;
}

std::string url_of(const std::string& name) {
  const std::string url = server_url(), any = "/postgres?";
  return std::string(url).replace(url.find(any), any.size(), "/" + name + "?");
}

// Databases are made once and emptied for each test that needs them; each process has its own.
void make_empty(const std::string& name) {
  Postgres server({server_url(), {}}, std::chrono::seconds(30));
  if (server.ask({"SELECT 1 FROM pg_database WHERE datname=$1", {sql_value(name)}}).rows() == 0)
    server.ask({"CREATE DATABASE " + name});
  Postgres database({url_of(name), {}}, std::chrono::seconds(30));
  database.run("SET client_min_messages=warning; DROP SCHEMA IF EXISTS sculptd CASCADE;");
}

// The databases of the files that the running test has named.
std::map<std::filesystem::path, std::string>& databases() {
  static std::map<std::filesystem::path, std::string> named;
  static const testing::TestInfo* test = nullptr;
  const testing::TestInfo* now = testing::UnitTest::GetInstance()->current_test_info();
  if (now != test) named.clear();
  test = now;
  return named;
}

}  // namespace

bool test_in_postgres() {
  return !server_url().empty();
}

std::string test_database(const std::filesystem::path& file) {
  auto& named = databases();
  const auto found = named.find(file);
  if (found != named.end()) return url_of(found->second);
  const std::string name = "test_" + std::to_string(::getpid()) + "_" + std::to_string(named.size());
  make_empty(name);
  named[file] = name;
  return url_of(name);
}

std::unique_ptr<FleetStore> open_test_fleet(const std::filesystem::path& file, StoreRules rules,
                                            const std::string& daemon, std::chrono::milliseconds lease) {
  FleetRules fleet{{test_database(file), {}}, {daemon, 2, rules.memory_bytes, rules.queues}, lease};
  return open_fleet_store(std::move(fleet), std::move(rules));
}

std::unique_ptr<JobStore> open_test_store(const std::filesystem::path& file, StoreRules rules) {
  if (test_in_postgres()) return open_test_fleet(file, std::move(rules));
  return open_sqlite_store(file, std::move(rules));
}

}  // namespace sculpt::server
