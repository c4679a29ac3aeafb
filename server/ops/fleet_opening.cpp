#include "server/ops/fleet_opening.hpp"

#include <spdlog/spdlog.h>

#include <fstream>
#include <string>

#include "server/access/secret.hpp"
#include "server/base/job_id.hpp"
#include "server/files/durable.hpp"
#include "server/files/store_mark.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

std::string first_word(const fs::path& file) {
  std::ifstream in(file);
  std::string word;
  in >> word;
  return word;
}

// The same for ever, so that a daemon that is started again knows its jobs.
std::string own_id(const fs::path& file) {
  if (!fs::exists(file)) write_durably(file, IdMaker().next(unix_ms()) + "\n");
  std::string id = first_word(file);
  if (id.empty()) throw DataFolderError("'" + file.string() + "' is empty: remove it, and the daemon gets a new name");
  return id;
}

void make_folders(const FolderPaths& shared) {
  std::error_code error;
  for (const fs::path& needed : {shared.folder, shared.blobs(), shared.jobs()}) {
    fs::create_directories(needed, error);
    if (error) {
      throw DataFolderError("cannot create the folder '" + needed.string() + "': " + error.message() +
                            "; name another with shared");
    }
  }
}

// Whatever is in the folder and unknown to the store is put aside: so it must be the store that it belongs to.
void check_owner(const FolderPaths& shared, const std::string& epoch) {
  const fs::path mark = shared.folder / "sculptd.fleet";
  if (!fs::exists(mark)) write_durably(mark, epoch + "\n");
  if (const std::string owner = first_word(mark); owner != epoch) {
    throw StoreLost(
        "the folder '" + shared.folder.string() + "' belongs to the store " + owner + ", and the database is " + epoch,
        "restore the database that belongs to it, name another folder with shared, or remove '" + mark.string() +
            "' to go on with the database as it is");
  }
}

// All daemons keep the files in the same way, else none would find another's.
void check_agreement(FleetStore& store, bool in_folder) {
  const std::string wanted = in_folder ? "folder" : "database", agreed = store.settle("files", wanted);
  if (wanted == agreed) return;
  throw ConfigError(in_folder ? "the other daemons of this store keep uploads and results in the database: leave out "
                                "the setting shared"
                              : "the other daemons of this store keep uploads and results in a folder that all of them "
                                "reach: name it with shared");
}

}  // namespace

void check_store_address(const Config& config) {
  if (!config.store.starts_with("postgresql://") && !config.store.starts_with("postgres://")) {
    throw ConfigError("store must be the address of a PostgreSQL database, postgresql://USER@HOST/NAME, not '" +
                      without_password(config.store) + "'; without it jobs are kept in the data folder");
  }
}

std::unique_ptr<FleetStore> open_fleet(const Config& config, const FolderPaths& own, int workers, StoreRules rules) {
  check_store_address(config);
  if (fs::exists(own.database()))
    spdlog::warn("the jobs in '{}' are not served: the store is {}", own.database().string(),
                 without_password(config.store));
  const bool in_folder = !config.shared.empty();
  const FolderPaths shared{config.shared};
  if (in_folder) make_folders(shared);
  FleetRules fleet;
  fleet.source = {config.store, config.store_password_file};
  fleet.lease = config.lease;
  fleet.keeps_files = !in_folder;
  fleet.member = {own_id(own.folder / "daemon"), workers, rules.memory_bytes, rules.queues};
  std::unique_ptr<FleetStore> store = open_fleet_store(std::move(fleet), std::move(rules));
  check_agreement(*store, in_folder);
  if (in_folder) check_owner(shared, store->epoch());
  return store;
}

std::string link_secret(FleetStore* fleet) {
  constexpr int secret_bytes = 32;
  const std::string mine = random_hex(secret_bytes);
  return fleet == nullptr ? mine : fleet->settle("link_secret", mine);
}

}  // namespace sculpt::server
