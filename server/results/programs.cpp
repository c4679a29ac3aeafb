#include "server/results/programs.hpp"

#include <algorithm>

#include "core/base/sha256.hpp"
#include "server/base/storage_error.hpp"
#include "server/files/durable.hpp"
#include "server/results/exported_file.hpp"
#include "server/results/isolated_program.hpp"
#include "server/run/job_run.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t programs_kept = 8, name_digits = 32;
constexpr std::uint64_t max_spec_bytes = 4096;
const std::string packed = ".zip", spec_end = ".program";

std::string stem_of(const proto::ProgramSpec& spec) {
  return "program-" + sha256_hex(proto::write_json(to_json(spec))).substr(0, name_digits);
}

bool is_program(const fs::path& file) {
  return file.extension() == packed && file.filename().string().starts_with("program-");
}

std::vector<fs::path> programs_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code missing;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, missing))
    if (is_program(entry.path())) found.push_back(entry.path());
  std::ranges::sort(found);
  return found;
}

void remove_program(const fs::path& file) {
  break_seal(file.parent_path(), {}, file.filename());
  std::error_code ignored;
  fs::remove(file, ignored);
  fs::remove(fs::path(file).replace_extension(spec_end), ignored);
}

fs::file_time_type age_of(const fs::path& file) {
  std::error_code gone;
  const fs::file_time_type written = fs::last_write_time(file, gone);
  return gone ? fs::file_time_type::min() : written;
}

/// Nothing where it cannot be read.
Json read_spec(const fs::path& folder, const std::string& job_folder, const std::string& stem) try {
  const std::optional<StoredFile> file = StoredFile::open(folder, job_folder, stem + spec_end);
  return file && file->size() <= max_spec_bytes ? proto::parse_json(file->read(0, file->size())) : Json();
} catch (const proto::JsonError&) {
  return {};
}

}  // namespace

std::string program_file(const proto::ProgramSpec& spec) {
  return stem_of(spec) + packed;
}

void Programs::make(const JobRecord& job, const proto::ProgramSpec& spec, const fs::path& draft,
                    const std::stop_token& stop) const {
  check_may_run(job);
  fetch_blobs(job, blobs_);
  proto::JobSpec timed = read_stored_spec(job);
  timed.motion = spec.motion;
  StoredSpec asked{proto::write_json(to_json(timed)), job.cell_bundle, job.id, 0, job.inherited, job.folder};
  try {
    program_in_child(std::move(asked), {spec, draft.filename()}, isolation_, stop);
  } catch (...) {
    std::error_code ignored;
    fs::remove(draft, ignored);
    throw;
  }
  if (!fs::is_regular_file(fs::symlink_status(draft)))
    throw StorageError("the process that wrote the program left none: check the space on the disk");
}

void Programs::keep(const fs::path& folder, const proto::ProgramSpec& spec) const {
  write_durably(folder / (stem_of(spec) + spec_end), proto::write_json(to_json(spec)));
  std::vector<fs::path> kept = programs_in(folder);
  std::erase(kept, folder / program_file(spec));
  std::ranges::stable_sort(kept, {}, age_of);
  for (std::size_t at = 0; at + programs_kept <= kept.size(); ++at) remove_program(kept[at]);
}

std::vector<std::string> program_files(const fs::path& folder, const std::string& job_folder) {
  std::vector<std::string> names;
  for (const fs::path& file : programs_in(folder / job_folder)) names.push_back(file.filename());
  return names;
}

Json list_programs(const fs::path& folder, const std::string& job_folder) {
  Json made = Json::array();
  for (const std::string& file : program_files(folder, job_folder)) {
    const std::optional<FileSeal> seal = read_seal(folder, job_folder, file);
    Json spec = read_spec(folder, job_folder, fs::path(file).stem());
    if (seal && spec.is_object())
      made.push_back({{"format", "zip"}, {"size", seal->size}, {"sha256", seal->sha256}, {"program", std::move(spec)}});
  }
  return made;
}

void check_may_run(const JobRecord& job) {
  if (job.error_code == "verify_failed")
    throw proto::ProtocolError("wrong_state", "the replay of the plan of job " + job.id +
                                                  " found faults, so it must not be run: plan it again");
}

}  // namespace sculpt::server
