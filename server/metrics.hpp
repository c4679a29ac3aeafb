// The daemon's figures in the text form that Prometheus collects.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace sculpt {

struct Services;

/// Text format 0.0.4. `connections` are open, `data` is Config::data: both are known on the I/O thread, and this is for
/// any other. Throws StorageError.
std::string metrics_text(const Services& services, std::size_t connections, const std::filesystem::path& data);

}  // namespace sculpt
