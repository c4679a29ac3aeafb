// What a job that continues another takes from it (server/run/inheritance.hpp).
#pragma once

#include <string>

#include "server/files/blobs.hpp"
#include "server/results/artifacts.hpp"
#include "server/store/job_store.hpp"

namespace sculpt::server {

/// Keeps what the job left as a blob, so that the job itself may go. Throws ProtocolError, with the pointer into a
/// submit, `not_found` and `gone`; `wrong_state` of a job that has not succeeded or was planned before such a thing was
/// kept; `artifact_damaged`.
std::string inherit(const proto::ContinueSpec& wanted, JobStore& store, const Artifacts& artifacts, Blobs& blobs);

}  // namespace sculpt::server
