// Reads .ndjson. Internal to trajectory/.
#pragma once

#include <iosfwd>
#include <memory>

#include "core/trajectory/trajectory_source.hpp"

namespace sculpt {

/// Throws InputError `trajectory_invalid` for a header that is none; so does what it gives, for what follows.
std::unique_ptr<TrajectorySource> open_text(std::istream& in);

}  // namespace sculpt
