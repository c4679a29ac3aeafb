#include "server/server.hpp"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <thread>

#include "server/data_folder.hpp"
#include "server/isolated_run.hpp"
#include "server/job_run.hpp"
#include "server/listener.hpp"
#include "server/net.hpp"
#include "server/services.hpp"
#include "server/session.hpp"

namespace sculpt {
namespace {

constexpr std::chrono::milliseconds tick_time{250};

int cores() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

// One core is left to the I/O thread.
int worker_count(const Config& config) {
  return config.workers > 0 ? config.workers : std::max(1, cores() - 1);
}

std::uint64_t job_memory(const Config& config) {
  const auto pages = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES));
  const auto page_bytes = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  return config.memory_bytes > 0 ? config.memory_bytes : pages * page_bytes / 4 * 3;
}

StoreRules store_rules(const Config& config) {
  StoreRules rules;
  rules.first_backoff_ms = static_cast<std::uint64_t>(config.retry_backoff.count());
  rules.isolate = config.isolate;
  rules.memory_bytes = job_memory(config);
  return rules;
}

JobDefaults job_defaults(const Config& config) {
  return {std::max(1, cores() / worker_count(config)), std::min(config.memory_cap_bytes, job_memory(config))};
}

RunJob choose_run(RunJob here, RunJob isolated) {
  return [here = std::move(here), isolated = std::move(isolated)](const JobRecord& job, const Watch& watch) {
    return job.isolated ? isolated(job, watch) : here(job, watch);
  };
}

}  // namespace

void Services::changed(const std::string& job) {
  net::post(io, [this, job] {
    streams.on_changed(job);
    waits.on_changed(job);
  });
}

struct Server::Impl {
  Impl(const Config& wanted, Planner given)
      : config(wanted),
        planner(std::move(given)),
        folder(config.data),
        store(open_sqlite_store(folder.database(), store_rules(config))),
        blobs(folder.blobs(), config.blob_limit_bytes),
        artifacts(folder.jobs(), *store, planner),
        scheduler(*store,
                  choose_run(make_run_job(planner, blobs, folder.jobs(), job_defaults(config)),
                             make_isolated_run({config.worker, blobs.folder(), folder.jobs(), job_defaults(config)})),
                  [this](const std::string& job) { services.changed(job); }),
        streams(*store, scheduler),
        waits(io, *store),
        listener(services) {
    if (const int left = store->recover(); left > 0)
      spdlog::warn("{} jobs were interrupted and are queued again", left);
  }

  void tick() {
    timer.expires_after(tick_time);
    timer.async_wait([this](const boost::system::error_code& error) {
      if (error) return;
      const auto now = Session::Clock::now();
      streams.tick(now);
      listener.for_each([&](Session& session) { session.check_stalled(now, config.stall); });
      tick();
    });
  }

  // Order of members = order of construction; whatever posts to `io` ends before it.
  Config config;
  Planner planner;
  DataFolder folder;
  std::unique_ptr<JobStore> store;
  net::io_context io{1};
  Blobs blobs;
  Artifacts artifacts;
  Scheduler scheduler;
  Streams streams;
  Waits waits;
  TaskQueue disk, admission, replays, exports;
  Services services{io,
                    config,
                    planner,
                    job_defaults(config),
                    worker_count(config),
                    *store,
                    blobs,
                    artifacts,
                    scheduler,
                    streams,
                    waits,
                    disk,
                    admission,
                    replays,
                    exports,
                    std::chrono::steady_clock::now()};
  Listener listener;
  net::steady_timer timer{io};
  net::signal_set signals{io};
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
  impl_->scheduler.start(impl_->services.workers);
  impl_->listener.start();
  impl_->tick();
  impl_->io.run();
  impl_->scheduler.stop();
  for (TaskQueue* queue : {&impl_->disk, &impl_->admission, &impl_->replays, &impl_->exports}) queue->stop();
}

void Server::stop() {
  net::post(impl_->io, [this] {
    impl_->listener.close();
    impl_->listener.for_each([](Session& session) { session.close("the daemon stops"); });
    impl_->io.stop();
  });
}

void Server::stop_on_signals() {
  impl_->signals.add(SIGINT);
  impl_->signals.add(SIGTERM);
  impl_->signals.async_wait([this](const boost::system::error_code& error, int signal) {
    if (error) return;
    spdlog::info("signal {}: stopping", signal);
    stop();
  });
}

}  // namespace sculpt
