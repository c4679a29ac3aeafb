// The daemon's figures in the text form that Prometheus collects.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>

#include "server/base/counters.hpp"
#include "server/fleet/fleet_store.hpp"

namespace sculpt::server {

/// What the figures are taken from.
struct MetricSources {
  JobStore& store;
  const Counters& counters;
  int workers;
  std::chrono::steady_clock::time_point started;
  FleetStore* fleet = nullptr;  ///< null: the store is this daemon's own
};

/// Text format 0.0.4. `connections` are open, `data` is Config::data: both are known on the I/O thread, and this is for
/// any other. Throws StorageError.
std::string metrics_text(const MetricSources& sources, std::size_t connections, const std::filesystem::path& data);

}  // namespace sculpt::server
