// The names under which daemon and command line introduce themselves.
#pragma once

namespace sculpt::proto {

extern const char* const version;      ///< e.g. "0.1.0"
extern const char* const server_name;  ///< "sculptd 0.1.0"
extern const char* const client_name;  ///< "sculpt 0.1.0"

}  // namespace sculpt::proto
