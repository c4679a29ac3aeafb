#include "server/job_description.hpp"

#include <unistd.h>

#include <istream>
#include <iterator>

#include "server/child_process.hpp"
#include "server/data_folder.hpp"

namespace sculpt {

std::string describe(const StoredSpec& stored, const Isolation& isolation) {
  return write_json({{"daemon", ::getpid()},
                     {"job", stored.job},
                     {"spec", stored.spec},
                     {"cell_bundle", stored.cell_bundle},
                     {"blobs", isolation.blobs.string()},
                     {"jobs", isolation.jobs.string()},
                     {"threads", isolation.defaults.threads},
                     {"memory_cap_bytes", isolation.defaults.memory_cap_bytes}});
}

DescribedJob take_description(std::istream& in) {
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const Json told = parse_json(text);
  DescribedJob described;
  described.blobs = told.at("blobs").get<std::string>();
  described.jobs = told.at("jobs").get<std::string>();
  hold_until_exit(described.jobs);
  tie_to_parent(told.at("daemon").get<pid_t>());
  described.job.id = told.at("job");
  described.job.spec = told.at("spec");
  described.job.cell_bundle = told.at("cell_bundle");
  described.defaults = {told.at("threads"), told.at("memory_cap_bytes")};
  return described;
}

}  // namespace sculpt
