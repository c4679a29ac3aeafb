// The daemon's figures in the text form that Prometheus collects.
#pragma once

#include <string>

namespace sculpt {

struct Services;

/// Text format 0.0.4. I/O thread. Throws StorageError.
std::string metrics_text(const Services& services);

}  // namespace sculpt
