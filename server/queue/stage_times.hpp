// How long jobs stay in each stage, seen from the progress that they report.
#pragma once

#include "server/base/counters.hpp"
#include "server/run/run_outcome.hpp"

namespace sculpt::server {

/// The same run, with the time of each stage added to the counters when the next one begins or the run ends, however
/// it ends. Refers to the counters.
RunJob with_stage_times(RunJob run, Counters& counters);

}  // namespace sculpt::server
