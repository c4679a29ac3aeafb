// How fast the queue of a fleet is: claims of several daemons at once, over a short queue, a long one, and while
// somebody holds a transaction open.
//   tests/fleet/with_postgres --durable build/release/bin/bench_fleet [--daemons N] [--queued N] [--jobs N] [--idle]
//   [--rate N]
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include "server/fleet/fleet_store.hpp"

namespace {

using namespace sculpt::server;
using Clock = std::chrono::steady_clock;

struct Wanted {
  int daemons = 4, queued = 1000, jobs = 1000;
  double rate = 0;
  bool idle = false;
};

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

void print(const char* what, std::vector<double> times_ms) {
  std::ranges::sort(times_ms);
  const auto at = [&](double share) {
    return times_ms.empty() ? 0.0
                            : times_ms[static_cast<std::size_t>(share * static_cast<double>(times_ms.size() - 1))];
  };
  std::printf("%-24s %6zu   p50 %7.2f ms   p99 %7.2f ms   max %7.2f ms\n", what, times_ms.size(), at(0.5), at(0.99),
              at(1));
}

std::unique_ptr<FleetStore> open(const PostgresSource& source, int number) {
  const std::string name = "bench-" + std::to_string(number);
  return open_fleet_store({source, {name, 1, 0}, std::chrono::seconds(30)});
}

// As many as wanted wait behind each other, without a submit for each.
void fill(Postgres& database, int queued) {
  database.ask(
      {"INSERT INTO sculptd.job(id, state, priority, not_before, start_by, max_runtime_s, spec, cell_bundle, "
       "memory_bytes, rank, wake_at, submitted_at, owner, inherited) SELECT lpad(n::text, 26, '0'), 'queued', "
       "n % 7, '', '', 0, '{}', '', 1, n - 1000 * (n % 7), '', '2026-01-31T12:00:00.000Z', '', '' "
       "FROM generate_series(1, $1) AS n",
       {sql_value(queued)}});
  database.ask(
      {"INSERT INTO sculptd.event(number, job, seq, time, state, data) SELECT nextval('sculptd.event_number'), "
       "number, 1, submitted_at, state, '{\"to\":\"queued\",\"reason\":\"submitted\"}' FROM sculptd.job"});
  database.run("ANALYZE;");
}

struct Times {
  std::mutex mutex;
  std::vector<double> claims, finishes;
  std::multiset<std::string> jobs;
};

// One daemon's worker, which plans nothing. With a rate, it takes so many jobs a second.
void work(FleetStore& store, int jobs, double rate, Times& all) {
  const Ending ending{JobState::succeeded, {}, {}, {{"report", "json", 3, "abc"}}, Cause::job};
  std::vector<double> claims, finishes;
  std::multiset<std::string> claimed;
  const auto begun = Clock::now();
  for (int i = 0; i < jobs; ++i) {
    if (rate > 0) std::this_thread::sleep_until(begun + std::chrono::duration<double>(i / rate));
    const auto start = Clock::now();
    const std::optional<JobRecord> job = store.claim();
    claims.push_back(ms_since(start));
    if (!job) continue;
    claimed.insert(job->id);
    const auto end = Clock::now();
    store.finish(job->id, job->attempt, ending);
    finishes.push_back(ms_since(end));
  }
  const std::lock_guard lock(all.mutex);
  all.claims.insert(all.claims.end(), claims.begin(), claims.end());
  all.finishes.insert(all.finishes.end(), finishes.begin(), finishes.end());
  all.jobs.insert(claimed.begin(), claimed.end());
}

void measure(const PostgresSource& source, const Wanted& wanted) {
  Postgres database(source, std::chrono::minutes(5)), idle(source, std::chrono::minutes(5));
  database.run("DROP SCHEMA IF EXISTS sculptd CASCADE;");
  open(source, 0);
  fill(database, wanted.queued);
  if (wanted.idle) {
    idle.run("SET idle_in_transaction_session_timeout=0;");
    idle.ask({"BEGIN"});
    idle.ask({"SELECT pg_current_xact_id(), count(*) FROM sculptd.job"});
  }
  std::vector<std::unique_ptr<FleetStore>> stores;
  for (int number = 0; number < wanted.daemons; ++number) stores.push_back(open(source, number));
  std::vector<double> pages;
  for (int i = 0; i < 50; ++i) {
    const auto start = Clock::now();
    stores.front()->list({.limit = 100});
    pages.push_back(ms_since(start));
  }
  Times times;
  const auto begun = Clock::now();
  {
    std::vector<std::jthread> workers;
    for (const auto& store : stores)
      workers.emplace_back([&] { work(*store, wanted.jobs / wanted.daemons, wanted.rate / wanted.daemons, times); });
  }
  const double seconds = ms_since(begun) / 1000;
  std::printf("%d daemons, %d queued%s: %.0f jobs a second, %zu claimed, %zu of them twice\n", wanted.daemons,
              wanted.queued, wanted.idle ? ", an open transaction" : "",
              static_cast<double>(times.jobs.size()) / seconds, times.jobs.size(),
              times.jobs.size() - std::set<std::string>(times.jobs.begin(), times.jobs.end()).size());
  print("a page of 100", pages);
  print("claim", times.claims);
  print("finish", times.finishes);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Claims of several daemons from one queue"};
  Wanted wanted;
  app.add_option("--daemons", wanted.daemons);
  app.add_option("--queued", wanted.queued);
  app.add_option("--jobs", wanted.jobs, "to be claimed and ended");
  app.add_option("--rate", wanted.rate, "of them a second; 0: as fast as it goes");
  app.add_flag("--idle", wanted.idle, "while another session holds a transaction open");
  CLI11_PARSE(app, argc, argv);
  const char* url = std::getenv("SCULPT_TEST_POSTGRES");
  if (url == nullptr) {
    std::fprintf(stderr, "run it with tests/fleet/with_postgres\n");
    return EXIT_FAILURE;
  }
  measure({url, {}}, wanted);
  return EXIT_SUCCESS;
}
