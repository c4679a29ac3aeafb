// Exceptions -> what a client is told of them.
#pragma once

#include "proto/json.hpp"

namespace sculpt::server {

/// Call inside a catch block: the exception as the `error` object of a reply. Logs what is the server's own fault.
Json current_error();

}  // namespace sculpt::server
