#include "server/results/job_cell.hpp"

#include <algorithm>

#include "proto/cell_bundle.hpp"
#include "proto/error_codes.hpp"

namespace sculpt::server {

std::string find_cell_file(JobStore& store, const Blobs& blobs, const CellPath& path) {
  const JobRecord job = find_job(store, path.job);
  if (path.file.empty()) return job.cell_bundle;
  const auto files = proto::read_cell_bundle(blobs.read(job.cell_bundle, "")).files;
  if (std::ranges::none_of(files, [&](const auto& file) { return file.second == path.file; }))
    throw proto::ProtocolError("not_found", "the cell of job " + path.job + " has no file with the hash '" + path.file +
                                                "': its bundle names those that it has");
  return path.file;
}

}  // namespace sculpt::server
