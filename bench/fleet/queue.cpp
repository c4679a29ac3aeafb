// How fast the queue of a fleet is: claims of several daemons at once, over a short queue, a long one, and while
// somebody holds a transaction open.
//   tests/fleet/with_postgres --durable build/release/bin/bench_fleet [--daemons N] [--queued N] [--jobs N] [--idle]
//   [--rate N] [--submit]
// Twenty minutes of 50 jobs a second, submitted, claimed and ended, beside an open transaction:
//   ... bench_fleet --queued 0 --jobs 60000 --rate 50 --submit --idle
// A line a minute says how it goes; at the end it fails where a claim was doubled, or the daemons gave no warning.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "server/fleet/fleet_store.hpp"

namespace {

using namespace sculpt::server;
using Clock = std::chrono::steady_clock;
constexpr double slow_look_s = 90;  // a figure of the database is so old at most

struct Wanted {
  int daemons = 4, queued = 1000, jobs = 1000;
  double rate = 0;
  bool idle = false, submit = false;
};

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

void print(const std::string& what, std::vector<double> times_ms) {
  std::ranges::sort(times_ms);
  const auto at = [&](double share) {
    return times_ms.empty() ? 0.0
                            : times_ms[static_cast<std::size_t>(share * static_cast<double>(times_ms.size() - 1))];
  };
  std::printf("%-24s %6zu   p50 %7.2f ms   p99 %7.2f ms   max %7.2f ms\n", what.c_str(), times_ms.size(), at(0.5),
              at(0.99), at(1));
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
  std::vector<double> submits, claims, finishes;
  std::multiset<std::string> jobs;

  void add(Times& other) {
    const std::lock_guard lock(mutex);
    for (auto part : {&Times::submits, &Times::claims, &Times::finishes}) {
      (this->*part).insert((this->*part).end(), (other.*part).begin(), (other.*part).end());
      (other.*part).clear();
    }
    jobs.merge(other.jobs);
  }
};

void submit_one(FleetStore& store, Times& times) {
  NewJob job;
  job.spec = "{}";
  const auto start = Clock::now();
  store.submit(job);
  times.submits.push_back(ms_since(start));
}

void claim_one(FleetStore& store, Times& times) {
  static const Ending ending{JobState::succeeded, {}, {}, {{"report", "json", 3, "abc"}}, Cause::job};
  const auto start = Clock::now();
  const std::optional<JobRecord> job = store.claim();
  times.claims.push_back(ms_since(start));
  if (!job) return;
  times.jobs.insert(job->id);
  const auto end = Clock::now();
  store.finish(job->id, job->attempt, ending);
  times.finishes.push_back(ms_since(end));
}

// One daemon's worker, which plans nothing. With a rate, it takes so many jobs a second.
void work(FleetStore& store, const Wanted& wanted, Times& all) {
  Times mine;
  const double rate = wanted.rate / wanted.daemons;
  const auto begun = Clock::now();
  for (int i = 0; i < wanted.jobs / wanted.daemons; ++i) {
    if (rate > 0) std::this_thread::sleep_until(begun + std::chrono::duration<double>(i / rate));
    if (wanted.submit) submit_one(store, mine);
    claim_one(store, mine);
    all.add(mine);
  }
}

// A line a minute, until it is over; gives the greatest age of a transaction that the daemons have seen.
double watch(FleetStore& store, Times& all, const std::atomic<bool>& over) {
  double oldest_s = 0;
  std::size_t told = 0;
  const auto begun = Clock::now();
  for (int minute = 1; !over; ++minute) {
    const auto end = begun + std::chrono::minutes(minute);
    while (!over && Clock::now() < end) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const DatabaseFigures figures = store.figures();
    oldest_s = std::max(oldest_s, figures.oldest_transaction_s);
    const std::lock_guard lock(all.mutex);
    std::printf("open transaction %4.0f s, dead rows %6zu\n", figures.oldest_transaction_s,
                static_cast<std::size_t>(figures.dead_rows));
    print("claims, minute " + std::to_string(minute),
          {all.claims.begin() + static_cast<std::ptrdiff_t>(told), all.claims.end()});
    std::fflush(stdout);
    told = all.claims.size();
  }
  return oldest_s;
}

bool measure(const PostgresSource& source, const Wanted& wanted) {
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
  for (const auto& store : stores)
    store->join("bench", {[](const std::string&, JobState) {}, [](const std::string&) {},
                          [](const std::string&) { return std::optional<sculpt::Progress>(); }});
  Times times;
  std::atomic<bool> over = false;
  double oldest_s = 0;
  std::jthread watcher([&] { oldest_s = watch(*stores.front(), times, over); });
  const auto begun = Clock::now();
  {
    std::vector<std::jthread> workers;
    for (const auto& store : stores) workers.emplace_back([&] { work(*store, wanted, times); });
  }
  const double seconds = ms_since(begun) / 1000;
  over = true;
  watcher.join();
  const std::size_t twice = times.jobs.size() - std::set<std::string>(times.jobs.begin(), times.jobs.end()).size();
  std::printf("%d daemons, %d queued%s: %.0f jobs a second, %zu claimed, %zu of them twice\n", wanted.daemons,
              wanted.queued, wanted.idle ? ", an open transaction" : "",
              static_cast<double>(times.jobs.size()) / seconds, times.jobs.size(), twice);
  print("a page of 100", pages);
  print("submit", times.submits);
  print("claim", times.claims);
  print("finish", times.finishes);
  const bool warned = !wanted.idle || oldest_s > seconds - slow_look_s;
  if (!warned) std::printf("the daemons say that the oldest transaction is of %.0f s\n", oldest_s);
  return twice == 0 && warned;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Claims of several daemons from one queue"};
  Wanted wanted;
  app.add_option("--daemons", wanted.daemons);
  app.add_option("--queued", wanted.queued);
  app.add_option("--jobs", wanted.jobs, "to be claimed and ended");
  app.add_option("--rate", wanted.rate, "of them a second; 0: as fast as it goes");
  app.add_flag("--submit", wanted.submit, "each daemon submits as many as it claims");
  app.add_flag("--idle", wanted.idle, "while another session holds a transaction open");
  CLI11_PARSE(app, argc, argv);
  const char* url = std::getenv("SCULPT_TEST_POSTGRES");
  if (url == nullptr) {
    std::fprintf(stderr, "run it with tests/fleet/with_postgres\n");
    return EXIT_FAILURE;
  }
  return measure({url, {}}, wanted) ? EXIT_SUCCESS : EXIT_FAILURE;
}
