#include "server/queue/shared_run.hpp"

#include <spdlog/spdlog.h>

#include <condition_variable>
#include <fstream>
#include <mutex>
#include <thread>

#include "core/base/error.hpp"
#include "core/base/sha256.hpp"
#include "server/base/storage_error.hpp"
#include "server/files/job_files.hpp"
#include "server/files/job_folder.hpp"
#include "server/run/job_run.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds look_every{1};

bool is_checkpoint(const fs::path& file) {
  return file.filename().string().starts_with("checkpoint-");
}

std::string read_file(const fs::path& file, std::uint64_t offset, std::uint64_t bytes) {
  std::ifstream in(file, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(offset));
  std::string read(bytes, '\0');
  in.read(read.data(), static_cast<std::streamsize>(read.size()));
  read.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, in.gcount())));
  return read;
}

std::uint64_t size_of(const fs::path& file) {
  std::error_code gone;
  const std::uintmax_t size = fs::file_size(file, gone);
  return gone ? 0 : size;
}

/// The files of one run, here and among the shared ones. Belongs to one thread at a time.
class Mirror {
 public:
  Mirror(SharedFiles& files, const JobRecord& job, fs::path folder)
      : files_(files), job_(job), folder_(std::move(folder)) {}

  /// Stores what was written since the last look. Checkpoints are read first and stored last, so that what they say of
  /// the other files is there.
  void look() {
    std::map<std::string, std::string> checkpoints;
    std::vector<std::string> growing;
    for (const fs::path& file : files_of_run(folder_)) {
      const std::string name = file.filename();
      if (is_checkpoint(file))
        checkpoints[name] = read_file(file, 0, size_of(file));
      else
        growing.push_back(name);
    }
    for (const std::string& name : growing) append(name);
    for (const auto& [name, content] : checkpoints) replace(name, content);
  }

  /// The run has ended with these: they are stored as they are, and nothing else of this attempt.
  void finish(const std::vector<StoredArtifact>& artifacts) {
    look();
    std::set<std::string> names, others;
    for (const StoredArtifact& artifact : artifacts) {
      const std::string name = artifact.artifact + "." + artifact.format;
      names.insert(path_of(name));
      // A run that went on from a checkpoint cut its files back, perhaps after the first look, and another build
      // continues otherwise.
      if (stored_[name].hash.hex() == artifact.sha256) continue;
      files_.remove({path_of(name)});
      stored_.erase(name);
      append(name);
      if (stored_[name].hash.hex() != artifact.sha256)
        throw StorageError("the file " + name + " of the run changed after its end: check the disk of the data folder");
    }
    for (const auto& [path, size] : files_.files_of(job_.id))
      if (path.starts_with(path_of("")) && !names.contains(path)) others.insert(path);
    files_.remove(others);
  }

 private:
  struct Stored {
    bool known = false;  // what is stored of it
    std::uint64_t bytes = 0;
    Sha256 hash;       // of those
    std::string last;  // of a checkpoint: the whole
  };

  std::string path_of(const std::string& name) const { return shared_path(job_.folder, name); }

  Stored& make(const std::string& name) {
    Stored& stored = stored_[name];
    if (stored.known) return stored;
    if (!files_.make(job_.id, job_.attempt, path_of(name)))
      throw StorageError("the job is another daemon's by now: its files are not stored any more");
    stored = {};
    const std::uint64_t there = files_.size(path_of(name)).value_or(0);
    while (stored.bytes < there && take_piece(stored, name, there).size() > 0) {
    }
    stored.known = true;
    return stored;
  }

  std::string take_piece(Stored& stored, const std::string& name, std::uint64_t end) const {
    std::string piece = read_file(folder_ / name, stored.bytes, std::min(shared_piece_bytes, end - stored.bytes));
    stored.hash.add(piece);
    stored.bytes += piece.size();
    return piece;
  }

  // After a failure nobody knows how much of it was stored.
  void append(const std::string& name) {
    const std::uint64_t end = size_of(folder_ / name);
    Stored& stored = make(name);
    try {
      while (stored.bytes < end) {
        const std::uint64_t offset = stored.bytes;
        const std::string piece = take_piece(stored, name, end);
        if (piece.empty()) return;
        files_.append(path_of(name), offset, piece);
      }
    } catch (...) {
      stored.known = false;
      throw;
    }
  }

  void replace(const std::string& name, const std::string& content) {
    Stored& stored = make(name);
    if (stored.last == content) return;
    files_.replace(path_of(name), content);
    stored.last = content;
  }

  SharedFiles& files_;
  const JobRecord& job_;
  fs::path folder_;
  std::map<std::string, Stored> stored_;
};

/// Looks each second, on a thread of its own, until it is destroyed.
class Looker {
 public:
  explicit Looker(Mirror& mirror) : thread_([&mirror, this](const std::stop_token& stop) { work(mirror, stop); }) {}

 private:
  void work(Mirror& mirror, const std::stop_token& stop) {
    std::string trouble;
    while (!stop.stop_requested()) {
      try {
        mirror.look();
        trouble.clear();
      } catch (const std::exception& error) {
        if (std::exchange(trouble, error.what()) != error.what())
          spdlog::warn("what a run writes cannot be stored for the others now: {}", error.what());
      }
      std::unique_lock lock(mutex_);
      wake_.wait_for(lock, stop, look_every, [] { return false; });
    }
  }

  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::jthread thread_;
};

// The last attempt's files, unless this daemon made that attempt, or a later one, itself.
void fetch_last_attempt(SharedFiles& files, const fs::path& jobs, const JobRecord& job) {
  std::map<int, std::vector<std::string>> attempts;
  for (const auto& [path, size] : files.files_of(job.id)) {
    const std::optional<int> attempt = attempt_of(fs::path(path).parent_path());
    if (attempt && *attempt < job.attempt) attempts[*attempt].push_back(path);
  }
  if (attempts.empty() || last_attempt(jobs / job.folder) >= attempts.rbegin()->first) return;
  const auto& [attempt, paths] = *attempts.rbegin();
  const fs::path folder = jobs / job.id / std::to_string(attempt), draft = folder.string() + ".draft";
  fs::remove_all(draft);
  for (const std::string& path : paths) download(files, path, draft / fs::path(path).filename());
  fs::rename(draft, folder);
  spdlog::info("job={} attempt={} goes on from the files of attempt {}", job.id, job.attempt, attempt);
}

// Until they are stored.
void finish(Mirror& mirror, const Ending& ending, const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any wake;
  while (true) {
    try {
      return mirror.finish(ending.artifacts);
    } catch (const DatabaseUnavailable& error) {
      spdlog::error("the files of a run cannot be stored yet: {}", error.what());
    }
    std::unique_lock lock(mutex);
    if (wake.wait_for(lock, stop, look_every, [] { return false; }); stop.stop_requested()) throw Cancelled{};
  }
}

}  // namespace

RunJob with_shared_files(RunJob run, SharedFiles* shared, const Blobs& blobs, const fs::path& jobs) {
  if (shared == nullptr) return run;
  return [run = std::move(run), &files = *shared, &blobs, jobs](const JobRecord& job, const Watch& watch) {
    fetch_blobs(job, blobs);
    fetch_last_attempt(files, jobs, job);
    Mirror mirror(files, job, jobs / job.folder);
    Ending ending;
    try {
      const Looker looker(mirror);
      ending = run(job, watch);
    } catch (...) {
      try {
        mirror.look();  // from here another daemon goes on
      } catch (const std::exception& error) {
        spdlog::warn("job={} the last it wrote is here only: {}", job.id, error.what());
      }
      throw;
    }
    finish(mirror, ending, watch.stop);
    return ending;
  };
}

}  // namespace sculpt::server
