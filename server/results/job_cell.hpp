// The cell that a job was submitted with: its bundle, and the files that this names.
#pragma once

#include <string>

#include "server/files/blobs.hpp"
#include "server/store/job_store.hpp"

namespace sculpt::server {

struct CellPath {
  std::string job;
  std::string file;  ///< hash of one that the bundle names; empty: the bundle itself
};

/// The blob that it is. Any thread. Throws ProtocolError `not_found`, `gone`, StorageError.
std::string find_cell_file(JobStore& store, const Blobs& blobs, const CellPath& path);

}  // namespace sculpt::server
