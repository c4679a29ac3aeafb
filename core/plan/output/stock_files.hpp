// What stands after each tool of a plan, as files.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>

#include "core/base/watch.hpp"
#include "core/plan/job.hpp"

namespace sculpt {

/// Gives the voxels that stand when a tool has done its last cut, tool by tool: a file's name ("1-D20.binvox") and its
/// content. A tool that is taken up again has another file then. `plan`: the trajectory of `job`, which has milling
/// tools. Throws InputError `trajectory_invalid`, and those of files that are no shape; Cancelled.
void give_stocks(const Job& job, std::istream& plan,
                 const std::function<void(const std::string& name, const std::string& binvox)>& give,
                 const Watch& watch);

}  // namespace sculpt
