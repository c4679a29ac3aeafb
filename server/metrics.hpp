// The server's figures in Prometheus' text format.
#pragma once

#include <string>

namespace sculpt {

struct Services;

/// I/O thread only.
std::string metrics_text(const Services& services);

}  // namespace sculpt
