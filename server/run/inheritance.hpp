// What a job that continues another takes from it, as text: the first of the jobs, which says where the target stands
// in which stock, and the clampings since. Fixed when the job is submitted, so that the others may go.
#pragma once

#include "proto/job_spec.hpp"

namespace sculpt::server {

/// Of a job that is continued: `spec` of it, with what it inherited itself, and how the next one clamps what it left
/// (the hash of a blob).
std::string inherited_text(const proto::JobSpec& spec, const proto::ClampingSpec& next);

/// Gives `spec`, of a job that continues another, placement, stock and clampings. Throws what parsing throws.
void read_inherited(const std::string& text, proto::JobSpec& spec);

}  // namespace sculpt::server
