// The path of an artifact in a URL -> which one is wanted.
#pragma once

#include <string_view>

#include "proto/messages.hpp"

namespace sculpt::server {

/// JOB/NAME[?FIELD=VALUE&...]: what of it is wanted is left open. Fields are `format`, and of a program those of its
/// spec and its `motion` (PROTOCOL.md, section 7). Throws ProtocolError `not_found`, `params_invalid`.
proto::ArtifactReadParams read_artifact_path(std::string_view path);

}  // namespace sculpt::server
