// The page of the daemon (clients/web): its files are in the program, or in a folder while they are worked on.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "server/http/http_reply.hpp"

namespace sculpt::server {

/// A file of the page as it is in the program.
struct PageFile {
  std::string_view name;  ///< below clients/web
  std::string_view gzip;
};
/// Sorted by name. Made at configuration (page.cmake).
std::span<const PageFile> page_files();

/// `/` and what is below `/ui/`: open to all, since a browser that goes to a page shows no token.
bool is_page(std::string_view target);

/// `folder`: read from there; empty: from the program. Any thread. Throws ProtocolError `not_found`.
HttpReply page_reply(const std::filesystem::path& folder, const HttpRequest& request);

}  // namespace sculpt::server
