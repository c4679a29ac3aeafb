// The cell of a job over HTTP.
#pragma once

#include "server/http/http_reply.hpp"
#include "server/results/job_cell.hpp"

namespace sculpt::server {

/// Any thread. Throws as find_cell_file.
HttpReply job_cell_reply(JobStore& store, const Blobs& blobs, const CellPath& path, const HttpRequest& request);

}  // namespace sculpt::server
