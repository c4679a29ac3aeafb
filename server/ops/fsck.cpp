#include "server/ops/fsck.hpp"

#include <algorithm>
#include <iterator>
#include <ostream>

#include "server/files/store_mark.hpp"
#include "server/ops/store_opening.hpp"
#include "server/store/job_store.hpp"
#include "server/store/sqlite/sqlite.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

void append(std::vector<Fault>& all, std::vector<Fault> more) {
  std::ranges::move(more, std::back_inserter(all));
}

void expect_folder(const fs::path& folder) {
  if (fs::is_directory(folder)) return;
  throw DataFolderError("there is no data folder '" + folder.string() + "': name it with --data");
}

// Prints the fault; false if it is still there.
bool settle(const Fault& fault, bool repair, std::ostream& out) {
  const bool can = static_cast<bool>(fault.repair);
  if (can && repair) fault.repair();
  const char* word = !can ? "" : repair ? "repaired: " : "with --repair: ";
  out << fault.what << "; " << word << fault.cure << "\n";
  return can && repair;
}

// What keeps a search from its end is a fault itself.
template <typename Find>
void look(std::vector<Fault>& all, Find find) {
  try {
    append(all, find());
  } catch (const std::runtime_error& error) {
    all.push_back({error.what(), "restore a backup of the data folder"});
  }
}

// A store that does not belong here, or is not whole, is left alone: nothing else can be said before that is settled.
std::vector<Fault> find_faults(const FolderPaths& folder, std::unique_ptr<JobStore>& store) {
  try {
    check_store(folder);
  } catch (const StoreLost& error) {
    return {{error.fault(), error.cure()}};
  }
  if (!fs::exists(folder.database())) return {};
  store = open_sqlite_store(folder.database());
  Database database(folder.database());
  std::vector<Fault> faults;
  look(faults, [&] { return find_store_faults(database); });
  look(faults, [&] { return find_artifact_faults(folder, database, *store); });
  look(faults, [&] { return find_blob_faults(folder); });
  look(faults, [&] { return find_missing_blobs(folder, *store); });
  look(faults, [&] { return find_stray_faults(folder, *store); });
  return faults;
}

}  // namespace

int run_fsck(const FolderPaths& folder, bool repair, std::ostream& out) {
  expect_folder(folder.folder);
  const FolderLock lock(folder.folder);
  await_runs(folder.jobs());
  std::unique_ptr<JobStore> store;  // for the repairs
  const std::vector<Fault> faults = find_faults(folder, store);
  std::size_t left = 0;
  for (const Fault& fault : faults) left += settle(fault, repair, out) ? 0 : 1;
  if (faults.empty()) out << "nothing is wrong\n";
  if (!faults.empty()) out << faults.size() << " faults, " << faults.size() - left << " repaired\n";
  return left == 0 ? 0 : 1;
}

}  // namespace sculpt::server
