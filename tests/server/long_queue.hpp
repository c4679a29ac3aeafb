// A store with many queued jobs, made without submitting each.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>

#include "server/store/sqlite/sqlite.hpp"

namespace sculpt::server {

/// The id of the n-th job, from 1 on; ids rise with n, their order in the queue does not.
inline std::string long_queue_id(int n) {
  char id[27];
  std::snprintf(id, sizeof id, "%026d", n);
  return id;
}

/// Adds so many queued jobs, each with its first event, to the database of a store that is not open.
inline void fill_queue(const std::filesystem::path& file, int jobs) {
  const std::string spec =
      R"({"mesh":{"blob":"a5ef04f55cfb16ec7d18c6e0d264b2237d9e09a529cb69e0174e594f8025eec8","name":"tetra.obj"},)"
      R"("robot":"gantry","resolution":8})";
  Database database(file);
  database.run(("BEGIN; WITH RECURSIVE numbers(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM numbers WHERE n < " +
                std::to_string(jobs) +
                ") INSERT INTO job(id, state, priority, spec, cell_bundle, submitted_at, rank) "
                "SELECT printf('%026d', n), 'queued', n % 7, '" +
                spec +
                "', '', '2026-01-31T12:00:00.000Z', n - 1000 * (n % 7) FROM numbers;"
                "INSERT INTO event(job, seq, time, state, data) SELECT number, 1, submitted_at, state, "
                "'{\"to\":\"queued\",\"reason\":\"submitted\"}' FROM job; COMMIT;")
                   .c_str());
}

}  // namespace sculpt::server
