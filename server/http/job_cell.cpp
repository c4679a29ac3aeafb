#include "server/http/job_cell.hpp"

#include <algorithm>

#include "proto/cell_bundle.hpp"

namespace sculpt::server {

HttpReply job_cell_reply(JobStore& store, const Blobs& blobs, const CellPath& path, const HttpRequest& request) {
  const JobRecord job = find_job(store, path.job);
  const std::string bundle = blobs.read(job.cell_bundle, "");
  const bool whole = path.file.empty();
  const auto files = proto::read_cell_bundle(bundle).files;
  if (!whole && std::ranges::none_of(files, [&](const auto& file) { return file.second == path.file; }))
    throw proto::ProtocolError("not_found", "the cell of job " + path.job + " has no file with the hash '" + path.file +
                                                "': /v1/jobs/" + path.job + "/cell/ names those that it has");
  const std::string tag = "\"" + (whole ? job.cell_bundle : path.file) + "\"";
  HttpReply reply{200, whole ? "application/json" : "application/octet-stream", {}, {}, {{"ETag", tag}}};
  if (is_known(request, tag))
    reply.status = 304;
  else
    reply.body = whole ? bundle : blobs.read(path.file, "");
  return reply;
}

}  // namespace sculpt::server
