#include "server/store/job_store.hpp"

#include <utility>

#include "proto/error_codes.hpp"

namespace sculpt::server {

JobRecord find_job(JobStore& store, const std::string& job, const std::string& pointer) {
  std::optional<JobRecord> record = store.find(job);
  if (!record && store.was_removed(job)) {
    throw proto::ProtocolError("gone", "job '" + job + "' has ended and its time of keeping is over: submit it again",
                               pointer);
  }
  if (!record) throw proto::ProtocolError("not_found", "there is no job '" + job + "'", pointer);
  return std::move(*record);
}

}  // namespace sculpt::server
