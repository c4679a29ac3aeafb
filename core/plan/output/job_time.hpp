// A job's plan -> how long it takes at the feed that the job asks for.
#pragma once

#include <filesystem>
#include <optional>

#include "core/base/watch.hpp"
#include "core/plan/job.hpp"
#include "core/plan/report.hpp"

namespace sculpt {

/// Times the job's finished trajectory, in the text form, and sets `report.time`. Gives the InputError `feed_not_kept`
/// where the plan is too slow at a place for `keep_feed`: the times are set as they would be without it. Nothing is
/// done for a job without `motion`. Throws InputError as time_plan; Cancelled.
std::optional<InputError> time_job(const Job& job, const std::filesystem::path& trajectory, Report& report,
                                   const Watch& watch);

}  // namespace sculpt
