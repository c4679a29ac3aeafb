// Which plan a checkpoint belongs to.
#pragma once

#include <string>

#include "core/plan/job.hpp"

namespace sculpt {

/// A hash of all of the job that the plan depends on, and of the running program: another build may plan otherwise, and
/// half of one plan does not fit half of another.
std::string job_key(const Job& job);

}  // namespace sculpt
