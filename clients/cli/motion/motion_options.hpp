// What time, sample and program are asked: a plan, the cell that it is for, and how fast it may be gone through.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "core/timing/timed_plan.hpp"

namespace sculpt::cli {

struct MotionOptions {
  std::string subject;  ///< a file or a job
  std::string robot;    ///< empty: the cell of the job, or the one that the file names
  double feed_m_s = 0, rapid_m_s = 0.5, reserve_um = 0;
  double keep_feed = 0;  ///< 0: any
  bool has_feed = false;
};

/// PLAN|JOB, --robot, --feed, --rapid, --keep-feed and --reserve-um.
void add_motion_options(CLI::App& command, MotionOptions& options);

/// Without a feed that of the fastest milling tool. Throws Failure where a thin tool is given none.
MotionDemands to_demands(const MotionOptions& options, const PlanPath& path);

/// Reads the file, or the job's trajectory from the server. Throws Failure, InputError, ServerError.
PlanPath read_path(const std::string& server, const MotionOptions& options);

/// Of --robot; without it that of the job, from the server, or the one that the file names.
Cell read_cell_of(const std::string& server, const PlanPath& path, const MotionOptions& options);

}  // namespace sculpt::cli
