// The gzip form of bytes (RFC 1952): the same bytes always give the same.
#pragma once

#include <iosfwd>
#include <string>
#include <string_view>

namespace sculpt::server {

/// Reads to the end of `in`. Errors of the streams are left to the caller.
void write_gzip(std::istream& in, std::ostream& out);

/// What was made gzip of, in one go. Throws std::runtime_error for bytes that are none.
std::string read_gzip(std::string_view bytes);

}  // namespace sculpt::server
