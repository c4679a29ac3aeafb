#include "server/http/job_cell_reply.hpp"

namespace sculpt::server {

HttpReply job_cell_reply(JobStore& store, const Blobs& blobs, const CellPath& path, const HttpRequest& request) {
  const std::string blob = find_cell_file(store, blobs, path);
  const std::string tag = "\"" + blob + "\"";
  const char* type = path.file.empty() ? "application/json" : "application/octet-stream";
  HttpReply reply{200, type, {}, {}, {{"ETag", tag}}};
  if (is_known(request, tag))
    reply.status = 304;
  else
    reply.body = blobs.read(blob, "");
  return reply;
}

}  // namespace sculpt::server
