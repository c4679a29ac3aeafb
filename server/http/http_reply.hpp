// What an HTTP request is answered with, before it is bytes.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "proto/json.hpp"
#include "proto/messages.hpp"

namespace sculpt::server {

struct WholeRead;

/// What of a request its answer hangs on.
struct HttpRequest {
  std::string method, target;
  std::string host, origin, authorization, range, if_range, if_none_match, accept_encoding;
};

/// Bytes of an artifact, read while they are sent: from `at.offset` on, `bytes` in all.
struct FilePart {
  proto::ArtifactReadParams at;
  std::uint64_t bytes = 0;
  std::shared_ptr<WholeRead> so_far = {};
};

struct HttpReply {
  unsigned status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string body;
  std::optional<FilePart> part = {};  ///< instead of a body
  std::vector<std::pair<std::string, std::string>> headers = {};
};

/// Whether the client has what the entity tag stands for: then the status is 304.
bool is_known(const HttpRequest& request, const std::string& tag);

/// The error of the catalogue as the body, under the status that fits it.
HttpReply error_reply(const Json& error_object);

}  // namespace sculpt::server
