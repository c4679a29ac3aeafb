// The job store of a data folder: held against what belongs there, then opened.
#pragma once

#include <memory>

#include "server/files/data_folder.hpp"
#include "server/store/job_store.hpp"

namespace sculpt::server {

/// The store is the one that belongs into the folder, and whole: there is one unless the folder is fresh, it is the one
/// that the mark names, and knows no less than the mark. Changes nothing. Throws StoreLost, StorageError.
void check_store(const FolderPaths& folder);

/// Checks, then opens; a fresh folder gets a fresh store. Throws StoreLost, StorageError.
std::unique_ptr<JobStore> open_store(const DataFolder& folder, StoreRules rules);

/// Takes the folder as it is: makes its store and mark fit each other and puts folders of unknown jobs aside. A store
/// that has lost something gets a new epoch, so that clients notice. Gives what was done, a sentence each. Throws
/// StoreLost (damaged: nothing to go on with), StorageError.
std::vector<std::string> adopt_store(const DataFolder& folder);

}  // namespace sculpt::server
