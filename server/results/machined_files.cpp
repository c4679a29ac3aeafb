#include "server/results/machined_files.hpp"

#include "proto/error_codes.hpp"
#include "server/base/storage_error.hpp"
#include "server/run/child_question.hpp"
#include "server/run/job_run.hpp"

namespace sculpt::server {

namespace fs = std::filesystem;

void MachinedFiles::make(const JobRecord& job, const ArtifactForm& form, const fs::path& draft,
                         const std::stop_token& stop) const {
  if (!read_stored_spec(job).mill)
    throw proto::ProtocolError("wrong_state", "job " + job.id + " has no milling tools, so there is no " + form.file +
                                                  " of it: submit it with --tools");
  fetch_blobs(job, blobs_);
  StoredSpec asked{job.spec, job.cell_bundle, job.id, 0, job.inherited, job.folder};
  asked.asked = {{"artifact", form.kind->artifact}, {"file", draft.filename()}};
  try {
    ask_about_result(std::move(asked), isolation_, {machined_job_option, "measured what the plan leaves"}, stop);
  } catch (...) {
    std::error_code ignored;
    fs::remove(draft, ignored);
    throw;
  }
  if (!fs::is_regular_file(fs::symlink_status(draft)))
    throw StorageError("the process that measured what the plan leaves wrote no file: check the space on the disk");
}

int run_isolated_machined(const Planner& planner) {
  return answer_parent(FolderUse::write, [&](const DescribedJob& described, const Job& job) {
    const fs::path file = described.folder() / described.asked.at("file").get<std::string>();
    (described.asked.at("artifact") == "surface" ? planner.surface : planner.stocks)(
        job, described.folder() / "trajectory.ndjson", file);
    return Json::object();
  });
}

}  // namespace sculpt::server
