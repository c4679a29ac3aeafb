#include "server/run/job_description.hpp"

#include <unistd.h>

#include <istream>
#include <iterator>

#include "server/confine/confinement.hpp"
#include "server/files/folder_lock.hpp"
#include "server/run/child_process.hpp"
#include "server/run/job_run.hpp"

namespace sculpt::server {
namespace {

// The clock of the wall is to stop it first: whoever reads that can say why.
constexpr std::int64_t spare_s = 10, helping_threads = 2;

Confinement confinement(const DescribedJob& described, const Job& job, FolderUse use) {
  Confinement wanted;
  wanted.memory_bytes = described.defaults.memory_cap_bytes;
  wanted.threads = job.threads;
  if (described.time_s > 0) wanted.cpu_s = (described.time_s + spare_s) * (job.threads + helping_threads);
  if (use != FolderUse::none) wanted.folder = described.folder();
  wanted.writes = use == FolderUse::write;
  return wanted;
}

}  // namespace

std::string describe(const StoredSpec& stored, const Isolation& isolation) {
  return proto::write_json({{"daemon", ::getpid()},
                            {"job", stored.job},
                            {"spec", stored.spec},
                            {"cell_bundle", stored.cell_bundle},
                            {"inherited", stored.inherited},
                            {"folder", stored.folder},
                            {"asked", stored.asked},
                            {"held", (isolation.held.empty() ? isolation.jobs : isolation.held).string()},
                            {"time_s", stored.time_s},
                            {"blobs", isolation.blobs.string()},
                            {"jobs", isolation.jobs.string()},
                            {"threads", isolation.defaults.threads},
                            {"memory_cap_bytes", isolation.defaults.memory_cap_bytes}});
}

std::optional<DescribedJob> take_description(std::istream& in) try {
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const Json told = proto::parse_json(text);
  DescribedJob described;
  described.blobs = told.at("blobs").get<std::string>();
  described.jobs = told.at("jobs").get<std::string>();
  hold_until_exit(told.at("held").get<std::string>());
  tie_to_parent(told.at("daemon").get<pid_t>());
  described.job.id = told.at("job");
  described.job.spec = told.at("spec");
  described.job.cell_bundle = told.at("cell_bundle");
  described.job.inherited = told.at("inherited");
  described.job.folder = told.at("folder");
  described.asked = told.at("asked");
  described.time_s = told.at("time_s");
  described.defaults = {told.at("threads"), told.at("memory_cap_bytes")};
  return described;
} catch (const proto::JsonError&) {
  return std::nullopt;
}

Job load_and_confine(const DescribedJob& described, FolderUse use) {
  const Blobs blobs(described.blobs, 0);
  Job job = to_job(read_stored_spec(described.job), described.job.cell_bundle, blobs, described.defaults);
  confine(confinement(described, job, use));
  return job;
}

CellFiles load_cell_and_confine(const DescribedJob& described) {
  const Blobs blobs(described.blobs, 0);
  CellFiles files = load_cell(described.job.cell_bundle, blobs, {});
  Job none;
  none.threads = described.defaults.threads;
  confine(confinement(described, none, FolderUse::none));
  return files;
}

}  // namespace sculpt::server
