#include "server/http/health.hpp"

#include "server/files/durable.hpp"
#include "server/fleet/fleet_store.hpp"

namespace sculpt::server {

std::string why_not_ready(const std::filesystem::path& data, std::uint64_t disk_floor_bytes, JobStore& store,
                          const FleetStore* fleet) {
  std::error_code error;
  const std::filesystem::space_info space = std::filesystem::space(data, error);
  if (error) return "the data folder cannot be looked at: " + error.message();
  if (space.available < disk_floor_bytes) {
    return "the disk of the data folder has " + std::to_string(space.available) + " free bytes, under the floor of " +
           std::to_string(disk_floor_bytes) + ": make room or lower disk_floor_bytes";
  }
  try {
    write_durably(data / "probe", "ready?\n");
    store.last_event({});
  } catch (const StorageError& fault) {
    return fault.what();
  }
  return fleet == nullptr ? std::string() : fleet->why_idle();
}

}  // namespace sculpt::server
