// What is counted while the daemon runs. Owned by Server; counted up where it happens, read by metrics.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "core/base/watch.hpp"
#include "server/base/histogram.hpp"

namespace sculpt::server {

/// Safe from any thread.
struct Counters {
  std::atomic<std::uint64_t> connections = 0;
  std::atomic<std::uint64_t> requests = 0, events = 0;
  std::atomic<std::uint64_t> bytes_in = 0, bytes_out = 0;  ///< of all connections
  std::array<Histogram, 6> stage_times;                    ///< by Stage
};

}  // namespace sculpt::server
