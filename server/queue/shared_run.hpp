// Runs of a fleet that has no folder in common: what they need is fetched, and what they write is stored among the
// files that all daemons share, while they write it.
#pragma once

#include "server/files/blobs.hpp"
#include "server/files/shared_files.hpp"
#include "server/run/run_outcome.hpp"

namespace sculpt::server {

/// The same run in a folder of `jobs`, which is this daemon's own. It goes on from the last checkpoint that any daemon
/// stored. Others see its files grow, a second late; all of them are stored when it returns, and nothing else of this
/// attempt. While they cannot be, it tries again each second, until it is told to stop. Without shared files the run is
/// as it was. Refers to files and blobs.
RunJob with_shared_files(RunJob run, SharedFiles* files, const Blobs& blobs, const std::filesystem::path& jobs);

}  // namespace sculpt::server
