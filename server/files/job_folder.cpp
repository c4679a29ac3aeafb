#include "server/files/job_folder.hpp"

#include <algorithm>
#include <charconv>

#include "server/files/durable.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

bool is_of_a_result(const fs::path& file) {
  const std::string kind = file.extension();
  return kind == ".csv" || kind == ".sct" || kind == ".gz" || kind == ".seal" || kind == ".law" || kind == ".zip" ||
         kind == ".program";
}

// Of the job, but this one; the last comes first. Drafts of folders are attempt 0, which no run has.
std::vector<std::pair<int, fs::path>> other_attempts(const fs::path& folder) {
  std::vector<std::pair<int, fs::path>> found;
  std::error_code missing;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.parent_path(), missing)) {
    const bool draft = entry.path().extension() == ".draft";
    const std::optional<int> attempt = draft ? std::optional(0) : attempt_of(entry.path());
    if (attempt && entry.path() != folder) found.emplace_back(*attempt, entry.path());
  }
  std::ranges::sort(found, std::greater{});
  return found;
}

// Checkpoints first: what is copied of the trajectory is then at least what they speak of.
void copy_run(const fs::path& from, const fs::path& to) {
  std::vector<fs::path> files = files_of_run(from);
  std::ranges::sort(files);
  for (const fs::path& file : files) {
    std::error_code gone;  // the run that lost the job may remove one meanwhile
    if (fs::copy_file(file, to / file.filename(), fs::copy_options::overwrite_existing, gone) && !gone)
      sync_to_disk(to / file.filename());
  }
}

void take_over(const fs::path& folder) {
  const auto others = other_attempts(folder);
  const int attempt = attempt_of(folder).value_or(0);
  const auto last = std::ranges::find_if(others, [&](const auto& other) { return other.first < attempt; });
  const fs::path draft = folder.string() + ".draft";
  fs::remove_all(draft);
  fs::create_directories(draft);
  if (last != others.end() && last->first > 0) copy_run(last->second, draft);
  sync_to_disk(draft);
  fs::rename(draft, folder);
  sync_to_disk(folder.parent_path());
  for (const auto& [number, older] : others) {
    std::error_code ignored;
    if (number < attempt) fs::remove_all(older, ignored);
  }
}

}  // namespace

std::optional<int> attempt_of(const fs::path& folder) {
  const std::string name = folder.filename();
  int attempt = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), attempt);
  return error == std::errc() && end == name.data() + name.size() ? std::optional(attempt) : std::nullopt;
}

int last_attempt(const fs::path& folder) {
  const int attempt = attempt_of(folder).value_or(0);
  for (const auto& [number, other] : other_attempts(folder))
    if (number < attempt) return number;
  return 0;
}

std::vector<fs::path> files_of_run(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code missing;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, missing))
    if (!entry.is_symlink() && entry.is_regular_file() && entry.path().extension() != ".draft" &&
        !is_of_a_result(entry.path()))
      files.push_back(entry.path());
  return files;
}

fs::path prepare_job_folder(const fs::path& jobs, const std::string& name) {
  const fs::path folder = jobs / name;
  for (const fs::path& part : {jobs / *fs::path(name).begin(), folder})
    if (fs::is_symlink(fs::symlink_status(part))) fs::remove(part);
  if (fs::path(name).has_parent_path() && !fs::exists(folder)) take_over(folder);
  fs::create_directories(folder);
  std::vector<fs::path> stale;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.is_symlink() || is_of_a_result(entry.path())) stale.push_back(entry.path());
  for (const fs::path& file : stale) fs::remove(file);
  sync_to_disk(folder.parent_path());
  return folder;
}

void remove_other_attempts(const fs::path& jobs, const std::string& folder) {
  if (!fs::path(folder).has_parent_path()) return;
  for (const auto& [attempt, other] : other_attempts(jobs / folder)) {
    std::error_code ignored;
    fs::remove_all(other, ignored);
  }
}

}  // namespace sculpt::server
