#include "server/server.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <csignal>
#include <thread>

#include "server/api/handlers.hpp"
#include "server/base/counters.hpp"
#include "server/base/crash_point.hpp"
#include "server/base/log.hpp"
#include "server/base/settled_config.hpp"
#include "server/confine/confinement.hpp"
#include "server/files/data_folder.hpp"
#include "server/listener.hpp"
#include "server/net/net.hpp"
#include "server/net/tls.hpp"
#include "server/ops/drain_limit.hpp"
#include "server/ops/fleet_opening.hpp"
#include "server/ops/service_manager.hpp"
#include "server/ops/settled_rules.hpp"
#include "server/ops/store_opening.hpp"
#include "server/queue/shared_run.hpp"
#include "server/queue/stage_times.hpp"
#include "server/results/retention.hpp"
#include "server/run/isolated_run.hpp"
#include "server/run/job_run.hpp"

namespace sculpt::server {
namespace {

constexpr std::chrono::milliseconds tick_time{250};
constexpr std::chrono::minutes sweep_time{1};
constexpr int ticks_per_status = 20;
constexpr int min_checks_at_once = 4;

RunJob choose_run(RunJob here, RunJob isolated) {
  return [here = std::move(here), isolated = std::move(isolated)](const JobRecord& job, const Watch& watch) {
    return job.isolated ? isolated(job, watch) : here(job, watch);
  };
}

void log_confinement() {
  const std::vector<std::string> missing = missing_confinement();
  if (missing.empty()) return;
  spdlog::warn(
      "the system refuses parts of what confines the processes that read clients' files: {}; see docs/server.md",
      fmt::join(missing, ", "));
}

}  // namespace

struct Server::Impl {
  Impl(const Config& wanted, Planner given)
      : config(wanted),
        planner(std::move(given)),
        folder(config.data),
        results(config.shared.empty() || config.store.empty() ? static_cast<const FolderPaths&>(folder)
                                                              : FolderPaths{config.shared}),
        store(open_any_store()),
        blobs(results.blobs(), config.blob_limit_bytes, shared_files()),
        isolation{config.worker, blobs.folder(), results.jobs(), job_defaults(config)},
        programs_of_jobs(blobs, isolation),
        machined_files(blobs, isolation),
        artifacts(JobFiles(results.jobs(), shared_files()), *store, planner, programs_of_jobs, machined_files),
        passed(config.data / "checked"),
        scheduler(*store,
                  with_stage_times(
                      with_shared_files(choose_run(make_run_job(planner, blobs, results.jobs(), job_defaults(config)),
                                                   make_isolated_run(isolation)),
                                        shared_files(), blobs, results.jobs()),
                      counters),
                  [this](const std::string& job) { changed(job); }),
        streams(io, *store, reads, scheduler),
        waits(io, *store, reads),
        retention(*store, blobs, artifacts),
        dispatcher(handlers(), streams, waits),
        listener(context, http, tcp_endpoint(config), make_tls(config)) {
    isolation.held = folder.jobs();
    isolation.result_time = config.result_time;
    if (fleet != nullptr) scheduler.ask_elsewhere([this](const std::string& job) { return fleet->progress(job); });
    if (!config.unix_socket.empty()) unix_listener.emplace(context, http, unix_endpoint(config), nullptr);
    if (const int left = store->recover(); left > 0)
      spdlog::warn("{} jobs were interrupted and are queued again", left);
    crash_point(CrashPoint::recovered);
  }

  std::unique_ptr<JobStore> open_any_store() {
    if (config.store.empty()) return open_store(folder, store_rules(config));
    std::unique_ptr<FleetStore> shared = open_fleet(config, folder, workers, store_rules(config));
    fleet = shared.get();
    return shared;
  }

  // Null where files are in a folder.
  SharedFiles* shared_files() const { return fleet == nullptr ? nullptr : fleet->files(); }

  // The answers to what other daemons do.
  FleetHooks fleet_hooks() {
    const auto on_change = [this](const std::string& job, JobState to) {
      tell(job);
      if (to == JobState::cancelling || to == JobState::pausing) scheduler.stop_run(job);
      if (to == JobState::queued) scheduler.wake();
    };
    return {on_change, [this](const std::string& job) { scheduler.abandon_run(job); },
            [this](const std::string& job) { return scheduler.progress_here(job); }};
  }

  Handlers handlers() {
    Handlers all;
    const auto change = [this](const std::string& job) { changed(job); };
    for (Handlers group :
         {server_handlers({answers, config, access, connections, *store, planner, workers, started, fleet}),
          blob_handlers({answers, blobs, disk}),
          submit_handlers({answers, config, *store, blobs, artifacts, scheduler, planner, job_defaults(config),
                           isolation, admission, checks, passed, change}),
          cell_handlers({answers, config, blobs, planner, job_defaults(config), isolation, admission, checks}),
          job_handlers({answers, config, *store, scheduler, waits, artifacts, blobs, isolation, reads, disk, replays}),
          sample_handlers({answers, *store, motions, samples, laws}),
          control_handlers({answers, *store, scheduler, changes, change}), event_handlers({answers, *store, streams}),
          artifact_handlers({answers, *store, artifacts, tickets, changes, disk, exports, programs})})
      all.merge(group);
    return all;
  }

  void tell(const std::string& job) {
    net::post(io, [this, job] {
      streams.on_changed(job);
      waits.on_changed(job);
    });
  }

  // A job changed its state: tells everybody who waits for that. Any thread.
  void changed(const std::string& job) {
    tell(job);
    disk.add([this, job](const std::stop_token&) {
      try {
        artifacts.discard_leftovers(job);
      } catch (const std::exception& error) {
        spdlog::error("job={} its files could not be removed: {}", job, error.what());
      }
    });
  }

  void tick() {
    timer.expires_after(tick_time);
    timer.async_wait([this](const boost::system::error_code& error) {
      if (error) return;
      const auto now = Connection::Clock::now();
      streams.tick(now);
      connections.for_each([&](Connection& connection) { connection.check_deadlines(now); });
      if (now >= next_sweep) sweep(now);
      manager.alive(now);
      if (manager.listens() && ticks++ % ticks_per_status == 0) manager.status(queue_sentence(*store));
      tick();
    });
  }

  // On the thread of disk work, where blobs are written.
  void sweep(Connection::Clock::time_point now) {
    next_sweep = now + sweep_time;
    const bool sweeps = fleet == nullptr || fleet->sweeps();
    disk.add([this, sweeps, rules = RetentionRules{config.keep, config.keep_bytes}](const std::stop_token&) {
      try {
        if (sweeps) retention.sweep(rules, unix_ms());
        retention.drop_copies(rules);
      } catch (const std::exception& error) {
        spdlog::error("old jobs and blobs cannot be removed: {}", error.what());
      }
    });
  }

  void reload() {
    manager.reloading();
    try {
      const Config wanted = reread();
      if (const auto fixed = changes_that_need_a_start(config, wanted); !fixed.empty()) {
        spdlog::error("the config is not reloaded, nothing changed: these take effect only at a start: {}",
                      fmt::join(fixed, ", "));
      } else {
        config = wanted;
        set_log(config);
        spdlog::info("the config is reloaded");
      }
    } catch (const ConfigError& error) {
      spdlog::error("the config is not reloaded, nothing changed: {}", error.what());
    }
    manager.ready();
  }

  void await_hangup() {
    hangups.async_wait([this](const boost::system::error_code& error, int) {
      if (error) return;
      reload();
      await_hangup();
    });
  }

  // Order of members = order of construction; whatever posts to `io` ends before it.
  const std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
  Config config;
  const int workers = worker_count(config);
  Planner planner;
  DataFolder folder;
  FolderPaths results;  // the same, or the one that a fleet has in common
  FleetStore* fleet = nullptr;
  std::unique_ptr<JobStore> store;
  net::io_context io{1};
  Blobs blobs;
  Isolation isolation;
  Programs programs_of_jobs;
  MachinedFiles machined_files;
  Artifacts artifacts;
  PassedChecks passed;
  Counters counters;
  Scheduler scheduler;
  Streams streams;
  Waits waits;
  Retention retention;
  Access access{config};
  Tickets tickets{link_secret(fleet), [this] { return fleet == nullptr ? unix_ms() : fleet->now_ms(); }};
  Connections connections;
  TaskQueue reads{Pace::prompt}, changes{Pace::prompt}, disk{Pace::prompt}, admission{Pace::prompt};
  CheckDesk checks{std::max(min_checks_at_once, cores())};
  Motions motions{artifacts, blobs, isolation};
  TaskQueue replays{Pace::background}, exports{Pace::background}, programs{Pace::background}, samples{Pace::prompt},
      laws{Pace::prompt};
  Answers answers{io, reads};
  Dispatcher dispatcher;
  ConnectionContext context{io, config, connections, counters, dispatcher};
  HttpSources http{access, tickets, *store,  blobs,   artifacts, {*store, counters, workers, started, fleet},
                   reads,  disk,    exports, programs};
  Listener listener;
  std::optional<Listener> unix_listener;
  net::steady_timer timer{io};
  Connection::Clock::time_point next_sweep;
  net::signal_set signals{io}, hangups{io};
  std::function<Config()> reread;
  ServiceManager manager;
  std::uint64_t ticks = 0;
};

Server::Server(const Config& config, Planner planner) : impl_(std::make_unique<Impl>(config, std::move(planner))) {}
Server::~Server() = default;

const std::string& Server::host() const {
  return impl_->config.host;
}
std::uint16_t Server::port() const {
  return impl_->listener.port();
}

void Server::run() {
  log_confinement();
  if (impl_->fleet != nullptr) impl_->fleet->join(host() + ":" + std::to_string(port()), impl_->fleet_hooks());
  impl_->scheduler.start(impl_->workers);
  impl_->listener.start();
  if (impl_->unix_listener) impl_->unix_listener->start();
  impl_->tick();
  impl_->manager.ready();
  impl_->io.run();
  impl_->manager.stopping();
  const DrainLimit limit(impl_->config.drain);
  impl_->scheduler.stop();
  for (TaskQueue* queue : {&impl_->reads, &impl_->changes, &impl_->disk, &impl_->admission, &impl_->replays,
                           &impl_->exports, &impl_->programs, &impl_->samples, &impl_->laws})
    queue->stop();
  impl_->checks.stop();
  if (impl_->fleet != nullptr) impl_->fleet->leave();
}

void Server::stop() {
  net::post(impl_->io, [this] {
    impl_->listener.close();
    if (impl_->unix_listener) impl_->unix_listener->close();
    impl_->connections.for_each([](Connection& connection) { connection.close("the daemon stops"); });
    impl_->io.stop();
  });
}

void Server::stop_on_signals() {
  impl_->signals.add(SIGINT);
  impl_->signals.add(SIGTERM);
  impl_->signals.async_wait([this](const boost::system::error_code& error, int signal) {
    if (error) return;
    spdlog::info("signal {}: stopping", signal);
    impl_->signals.clear();
    stop();
  });
}

void Server::reload_on_hangup(std::function<Config()> reread) {
  impl_->reread = std::move(reread);
  impl_->hangups.add(SIGHUP);
  impl_->await_hangup();
}

}  // namespace sculpt::server
