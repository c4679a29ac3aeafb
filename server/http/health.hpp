// Whether new work can be taken.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace sculpt::server {

class FleetStore;
class JobStore;

/// Why the server is not ready, as a sentence; empty: it is. `fleet` may be null. Touches the disk: not on the I/O
/// thread.
std::string why_not_ready(const std::filesystem::path& data, std::uint64_t disk_floor_bytes, JobStore& store,
                          const FleetStore* fleet);

}  // namespace sculpt::server
