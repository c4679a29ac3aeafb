#include "server/ops/settled_rules.hpp"

#include <unistd.h>

#include <algorithm>
#include <thread>

namespace sculpt::server {
namespace {

std::uint64_t job_memory(const Config& config) {
  const auto pages = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES));
  const auto page_bytes = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  return config.memory_bytes > 0 ? config.memory_bytes : pages * page_bytes / 4 * 3;
}

}  // namespace

int cores() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

int worker_count(const Config& config) {
  return config.workers > 0 ? config.workers : std::max(1, cores() - 1);
}

StoreRules store_rules(const Config& config) {
  StoreRules rules;
  rules.first_backoff_ms = static_cast<std::uint64_t>(config.retry_backoff.count());
  rules.isolate = config.isolate;
  rules.max_jobs = config.max_jobs;
  rules.max_jobs_per_owner = config.max_jobs_per_owner;
  rules.memory_bytes = job_memory(config);
  rules.queues = config.queues;
  return rules;
}

JobDefaults job_defaults(const Config& config) {
  return {std::max(1, cores() / worker_count(config)), std::min(config.memory_cap_bytes, job_memory(config))};
}

}  // namespace sculpt::server
