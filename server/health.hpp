// Whether new work can be taken.
#pragma once

#include <string>

namespace sculpt {

struct Services;

/// Why the server is not ready, as a sentence; empty: it is. Touches the disk: not on the I/O thread.
std::string why_not_ready(const Services& services);

}  // namespace sculpt
