#include "server/results/continuation.hpp"

#include "server/run/inheritance.hpp"
#include "server/run/job_run.hpp"

namespace sculpt::server {
namespace {

const std::string pointer = "/params/spec/continue/job";

}  // namespace

std::string inherit(const proto::ContinueSpec& wanted, JobStore& store, const Artifacts& artifacts, Blobs& blobs) {
  const JobRecord job = find_job(store, wanted.job, pointer);
  if (job.state != JobState::succeeded)
    throw proto::ProtocolError("wrong_state",
                               "job " + job.id + " is " + name(job.state) +
                                   ", so it has left nothing to continue with: wait until it has succeeded",
                               pointer);
  const std::string left = artifacts.read_whole(job, "stock");
  return inherited_text(read_stored_spec(job), {blobs.add(left), wanted.rotation_rad});
}

}  // namespace sculpt::server
