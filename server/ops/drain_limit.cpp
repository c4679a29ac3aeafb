#include "server/ops/drain_limit.hpp"

#include <spdlog/spdlog.h>
#include <sysexits.h>

#include <condition_variable>
#include <cstdlib>
#include <mutex>

namespace sculpt::server {

DrainLimit::DrainLimit(std::chrono::milliseconds time)
    : timer_([time](std::stop_token stop) {
        std::mutex mutex;
        std::condition_variable_any never;
        std::unique_lock lock(mutex);
        never.wait_for(lock, stop, time, [] { return false; });
        if (stop.stop_requested()) return;
        spdlog::critical("the running jobs did not end within {} ms: ending without them", time.count());
        std::_Exit(EX_TEMPFAIL);
      }) {}

}  // namespace sculpt::server
