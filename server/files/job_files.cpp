#include "server/files/job_files.hpp"

#include "server/files/job_folder.hpp"
#include "server/files/shared_files.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

std::uint64_t folder_bytes(const fs::path& folder) {
  std::uint64_t bytes = 0;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder, error)) {
    std::error_code gone;
    const std::uintmax_t size = entry.is_regular_file(gone) ? entry.file_size(gone) : 0;
    if (!gone) bytes += size;
  }
  return bytes;
}

}  // namespace

std::string shared_path(const std::string& job_folder, const std::string& name) {
  return "jobs/" + job_folder + "/" + name;
}

std::optional<StoredFile> JobFiles::open(const std::string& job_folder, const std::string& name) const {
  if (shared_ == nullptr) return StoredFile::open(folder_, job_folder, name);
  return StoredFile::open(*shared_, shared_path(job_folder, name));
}

void JobFiles::fetch(const std::string& job_folder, const std::string& name) const {
  if (shared_ == nullptr) return;
  const std::string path = shared_path(job_folder, name);
  const std::optional<std::uint64_t> size = shared_->size(path);
  const std::optional<StoredFile> here = StoredFile::open(folder_, job_folder, name);
  if (size && (!here || here->size() != *size)) download(*shared_, path, folder_ / job_folder / name);
}

std::function<std::uint64_t(const std::string&)> JobFiles::sizes() const {
  if (shared_ == nullptr) return [folder = folder_](const std::string& job) { return folder_bytes(folder / job); };
  return [sizes = shared_->bytes_of_jobs()](const std::string& job) {
    const auto found = sizes.find(job);
    return found == sizes.end() ? 0 : found->second;
  };
}

std::set<std::string> JobFiles::jobs() const {
  std::set<std::string> jobs;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, error)) jobs.insert(entry.path().filename());
  if (shared_ != nullptr)
    for (const auto& [job, bytes] : shared_->bytes_of_jobs()) jobs.insert(job);
  return jobs;
}

void JobFiles::drop_copies(const std::string& job, std::chrono::seconds age) const {
  if (shared_ == nullptr) return;
  const auto oldest = fs::file_time_type::clock::now() - age;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_ / job, error)) {
    std::error_code gone;
    if (const auto written = entry.last_write_time(gone); !gone && written > oldest) return;
  }
  fs::remove_all(folder_ / job, error);
}

void JobFiles::remove(const std::string& job, const std::string& kept) const {
  std::error_code ignored;
  kept.empty() ? static_cast<void>(fs::remove_all(folder_ / job, ignored)) : remove_other_attempts(folder_, kept);
  if (shared_ == nullptr) return;
  std::set<std::string> others;
  for (const auto& [path, size] : shared_->files_of(job))
    if (kept.empty() || !path.starts_with(shared_path(kept, ""))) others.insert(path);
  shared_->remove(others);
}

}  // namespace sculpt::server
