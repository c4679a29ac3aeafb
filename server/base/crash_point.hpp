// Places where a test can let the daemon die as kill -9 would: SCULPT_CRASH_AT=NAME, or NAME:N for the N-th visit.
// Without that variable a place costs one branch.
#pragma once

namespace sculpt::server {

enum class CrashPoint {
  recovered,           // jobs of the daemon before are back in the queue
  blob_written,        // the bytes of a chunk are written
  blob_synced,         // a whole blob is on disk under its temporary name
  blob_renamed,        // it has its name, which is not on disk yet
  before_commit,       // of any transaction
  after_commit,        //
  submit_stored,       // the job is stored, its client does not know yet
  trajectory_planned,  // the planner is done, nothing else is written
  draft_written,       // of any file that is written as a whole
  draft_synced,        //
  draft_renamed,       //
  artifacts_synced,    // all files of a job are on disk
  ending_known,        // the job is not yet stored as ended
  ending_stored,       //
  export_synced,       // a csv or binary trajectory is on disk under its temporary name
  job_removed,         // a finished job whose time is over is out of the store, its files are still there
  files_removed,       // they are gone too
};

/// Call before the first thread. `wanted` is the value of the variable, nullptr if it is not set. Throws ConfigError
/// for a name that does not exist; its sentence has all names.
void arm_crash_point(const char* wanted);

extern bool crash_point_armed;
/// Any thread.
void visit_crash_point(CrashPoint point);

inline void crash_point(CrashPoint point) {
  if (crash_point_armed) visit_crash_point(point);
}

}  // namespace sculpt::server
