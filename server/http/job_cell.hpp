// The cell that a job was submitted with: its bundle, and the files that this names.
#pragma once

#include <string>

#include "server/files/blobs.hpp"
#include "server/http/http_reply.hpp"
#include "server/store/job_store.hpp"

namespace sculpt::server {

struct CellPath {
  std::string job;
  std::string file;  ///< hash of one that the bundle names; empty: the bundle itself
};

/// Any thread. Throws ProtocolError `not_found`, `gone`, StorageError.
HttpReply job_cell_reply(JobStore& store, const Blobs& blobs, const CellPath& path, const HttpRequest& request);

}  // namespace sculpt::server
