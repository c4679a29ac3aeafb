// What the settings leave open is settled by the machine: cores, workers, memory.
#pragma once

#include "server/base/config.hpp"
#include "server/run/translate.hpp"
#include "server/store/job_store.hpp"

namespace sculpt::server {

/// Of this machine, at least 1.
int cores();
/// Jobs that run at once. One core is left to the I/O thread.
int worker_count(const Config& config);
StoreRules store_rules(const Config& config);
/// A job gets its share of the cores.
JobDefaults job_defaults(const Config& config);

}  // namespace sculpt::server
