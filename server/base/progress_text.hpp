// How far a job is, as one process tells another: a run its daemon, a daemon the others of its fleet.
#pragma once

#include <optional>
#include <string>

#include "core/base/watch.hpp"
#include "proto/json.hpp"

namespace sculpt::server {

Json progress_json(const Progress& progress);
/// Nothing of what another version says and we cannot read.
std::optional<Progress> read_progress(const Json& json);
/// The same as text; of an empty one nothing.
std::optional<Progress> read_progress_text(const std::string& text);

}  // namespace sculpt::server
