// Rows of the table of jobs -> records.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "server/store/job_store.hpp"
#include "server/store/sqlite.hpp"

namespace sculpt::server {

/// A job with the number of its row.
struct JobRow {
  std::int64_t number = 0;
  JobRecord job;
};

/// `rest` is what stands behind WHERE, with a ? for each value. Throws StorageError, also for a damaged row.
std::vector<JobRow> select_jobs(Database& database, const std::string& rest, const std::vector<std::string>& values);
std::optional<JobRow> select_job(Database& database, const std::string& rest, const std::vector<std::string>& values);

/// The same, with damaged rows set aside; ends behind `limit` good ones, and `more` says whether another row follows.
JobPage select_page(Database& database, const std::string& rest, const std::vector<std::string>& values, int limit);

}  // namespace sculpt::server
