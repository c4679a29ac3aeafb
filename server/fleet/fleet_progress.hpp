// How far a job is, as the daemon that runs it tells the others.
#pragma once

#include <optional>
#include <string>

#include "core/base/watch.hpp"

namespace sculpt::server {

std::string progress_text(const Progress& progress);
/// Nothing of an empty text, or of one that another version wrote and we cannot read.
std::optional<Progress> read_progress_text(const std::string& text);

}  // namespace sculpt::server
