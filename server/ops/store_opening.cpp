#include "server/ops/store_opening.hpp"

#include "server/base/job_id.hpp"
#include "server/files/orphans.hpp"
#include "server/files/store_mark.hpp"
#include "server/store/sqlite/sqlite.hpp"
#include "server/store/sqlite/store_facts.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

bool has_results(const FolderPaths& folder) {
  const auto filled = [](const fs::path& path) {
    std::error_code missing;
    return fs::directory_iterator(path, missing) != fs::directory_iterator();
  };
  return filled(folder.jobs()) || filled(folder.blobs());
}

[[noreturn]] void refuse(const FolderPaths& folder, const std::string& what) {
  throw StoreLost("'" + folder.database().string() + "' " + what, restore_or_adopt);
}

void refuse_damaged(const FolderPaths& folder, const StoreFacts& facts) {
  if (facts.damage.empty()) return;
  throw StoreLost("'" + folder.database().string() + "' is damaged (" + facts.damage + ")",
                  "restore a backup of the data folder; or put sculptd.db, sculptd.db-wal and sculptd.db-shm aside and "
                  "run 'sculptd adopt', which goes on without any job");
}

void refuse_lost(const FolderPaths& folder, const std::optional<StoreFacts>& facts, const std::optional<Mark>& mark) {
  if (!facts) {
    if (mark || has_results(folder))
      refuse(folder, "is missing or empty, but the folder is not: all jobs are lost, and their results would be");
    return;
  }
  refuse_damaged(folder, *facts);
  if (!mark) return;
  if (facts->epoch != mark->store) {
    refuse(folder, "is another store (" + facts->epoch + ") than the one that belongs here (" + mark->store + ")");
  }
  if (facts->changes < mark->changes) {
    refuse(folder, "knows " + std::to_string(facts->changes) + " changes of jobs, and " +
                       std::to_string(mark->changes) +
                       " were acknowledged: it is an older copy, or sculptd.db-wal was cut or removed");
  }
}

bool lacks(const std::optional<StoreFacts>& facts, const std::optional<Mark>& mark) {
  return facts && mark && facts->epoch == mark->store && facts->changes < mark->changes;
}

void renew_epoch(const fs::path& file) {
  Database database(file);
  Statement(database, "UPDATE meta SET value=? WHERE name='epoch'").bind(IdMaker().next(unix_ms())).run();
}

// A log without its database would be deleted by the one that is made now.
void keep_log(const fs::path& database) {
  const fs::path log = database.string() + "-wal";
  std::error_code ignored;
  if (fs::exists(log)) fs::rename(log, log.string() + ".old", ignored);
}

std::vector<std::string> put_orphans_aside(JobStore& store, const fs::path& jobs) {
  std::vector<std::string> unknown, done;
  for (const fs::directory_entry& entry : fs::directory_iterator(jobs)) {
    const std::string name = entry.path().filename();
    if (!store.find(name) && !store.was_removed(name)) unknown.push_back(name);
  }
  for (const std::string& name : unknown) {
    const fs::path place = put_aside(jobs, name);
    if (!place.empty()) done.push_back("job folder " + name + ": no job has it, it is now " + place.string());
  }
  return done;
}

// A mark that cannot be read is no reason not to adopt.
std::optional<Mark> mark_if_readable(const fs::path& file) {
  try {
    return read_mark(file);
  } catch (const StoreLost&) {
    return std::nullopt;
  }
}

}  // namespace

void check_store(const FolderPaths& folder) {
  refuse_lost(folder, read_store_facts(folder.database()), read_mark(folder.mark()));
}

std::unique_ptr<JobStore> open_store(const DataFolder& folder, StoreRules rules) {
  check_store(folder);
  const auto mark = std::make_shared<std::optional<MarkFile>>();
  rules.committed = [mark](std::uint64_t changes) {
    if (*mark) (*mark)->raise(changes);
  };
  std::unique_ptr<JobStore> store = open_sqlite_store(folder.database(), std::move(rules));
  mark->emplace(folder.mark(), store->epoch());
  return store;
}

std::vector<std::string> adopt_store(const DataFolder& folder) {
  const std::optional<StoreFacts> facts = read_store_facts(folder.database());
  if (facts) refuse_damaged(folder, *facts);
  if (!facts) keep_log(folder.database());
  if (lacks(facts, mark_if_readable(folder.mark()))) renew_epoch(folder.database());
  const std::unique_ptr<JobStore> store = open_sqlite_store(folder.database());
  const std::uint64_t changes = facts ? facts->changes : 0;
  write_mark(folder.mark(), {store->epoch(), changes});
  std::vector<std::string> done{"store " + store->epoch() + " with " + std::to_string(changes) + " changes of jobs"};
  std::ranges::move(put_orphans_aside(*store, folder.jobs()), std::back_inserter(done));
  return done;
}

}  // namespace sculpt::server
