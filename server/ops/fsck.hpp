// sculptd fsck: looks at all that a data folder holds, and repairs what can be.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "server/files/data_folder.hpp"

namespace sculpt::server {

class Database;
class JobStore;

/// Something that is wrong, and what can be done about it.
struct Fault {
  std::string what;
  std::string cure;                   ///< for people; where it can be repaired: what that does
  std::function<void()> repair = {};  ///< empty: cannot be repaired here
};

/// Looks, and with `repair` repairs. Prints a line for each fault, and one at the end. Gives 0 when nothing is wrong
/// any more, else 1. Throws DataFolderError (no folder, or a daemon uses it), StorageError.
int run_fsck(const FolderPaths& folder, bool repair, std::ostream& out);

// Its parts. None changes anything before a repair is called.
/// The database is whole, jobs are in known states, their events are numbered without a gap.
std::vector<Fault> find_store_faults(Database& database);
/// Every artifact is the file that was stored; `store` notes damage.
std::vector<Fault> find_artifact_faults(const FolderPaths& folder, Database& database, JobStore& store);
/// Every blob has the hash that it is named by.
std::vector<Fault> find_blob_faults(const FolderPaths& folder);
/// The blobs that jobs need are there.
std::vector<Fault> find_missing_blobs(const FolderPaths& folder, JobStore& store);
/// Folders of unknown jobs, drafts of files.
std::vector<Fault> find_stray_faults(const FolderPaths& folder, JobStore& store);

}  // namespace sculpt::server
