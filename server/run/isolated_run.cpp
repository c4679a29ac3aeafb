#include "server/run/isolated_run.hpp"

#include <signal.h>
#include <sysexits.h>

#include <cstdio>
#include <iostream>
#include <mutex>
#include <thread>

#include "server/base/progress_text.hpp"
#include "server/base/storage_error.hpp"
#include "server/files/durable.hpp"
#include "server/files/job_folder.hpp"
#include "server/run/child_process.hpp"
#include "server/run/job_run.hpp"

namespace sculpt::server {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds look_every{50};
constexpr std::chrono::milliseconds tell_every{100};
constexpr std::size_t max_line = 1 << 20;
const std::string failed_sync = "exit code " + std::to_string(EX_IOERR);

Json to_json(const Ending& ending) {
  Json artifacts = Json::array();
  for (const StoredArtifact& artifact : ending.artifacts)
    artifacts.push_back({artifact.artifact, artifact.format, artifact.size, artifact.sha256});
  return {{"succeeded", ending.state == JobState::succeeded},
          {"code", ending.error_code},
          {"sentence", ending.error_sentence},
          {"passing", ending.cause == Cause::fault},
          {"artifacts", std::move(artifacts)}};
}

Ending read_ending(const Json& json) {
  Ending ending;
  ending.state = json.at("succeeded").get<bool>() ? JobState::succeeded : JobState::failed;
  ending.error_code = json.at("code");
  ending.error_sentence = json.at("sentence");
  ending.cause = json.at("passing").get<bool>() ? Cause::fault : Cause::job;
  for (const Json& artifact : json.at("artifacts"))
    ending.artifacts.push_back({artifact.at(0), artifact.at(1), artifact.at(2), artifact.at(3)});
  return ending;
}

// What a process says that has read strangers' files is not believed either.
Progress heard_progress(const Json& json) {
  const std::optional<Progress> progress = read_progress(json);
  if (!progress) throw CrashError("the process that planned it speaks of a stage that is none");
  return *progress;
}

// What a child has said.
struct Conversation {
  std::string unread;
  std::optional<Ending> ending;
  bool let_go = false;

  void hear(const std::string& bytes, const Watch& watch) {
    unread += bytes;
    for (std::size_t end = 0; (end = unread.find('\n')) != std::string::npos; unread.erase(0, end + 1)) {
      const Json line = proto::parse_json(unread.substr(0, end));
      if (line.contains("progress") && watch.tell) watch.tell(heard_progress(line["progress"]));
      if (line.contains("ending")) ending = read_ending(line["ending"]);
      if (line.contains("let_go")) let_go = true;
    }
    if (unread.size() > max_line) throw CrashError("the process that planned it says things that make no sense");
  }
};

// Asks the child to stop when that is wished, and once more with force.
class Stopper {
 public:
  Stopper(const std::stop_token& stop, std::chrono::milliseconds grace) : stop_(stop), grace_(grace) {}

  void look(ChildProcess& child) {
    if (!stop_.stop_requested()) return;
    if (!asked()) {
      kill_at_ = Clock::now() + grace_;
      child.signal(SIGTERM);
    } else if (Clock::now() > kill_at_) {
      child.signal(SIGKILL);
    }
  }
  bool asked() const { return kill_at_ != Clock::time_point::max(); }

 private:
  const std::stop_token& stop_;
  std::chrono::milliseconds grace_;
  Clock::time_point kill_at_ = Clock::time_point::max();
};

// Nobody knows what of its files is on disk: none of them may be gone on from.
[[noreturn]] void start_over_after_failed_sync(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::remove_all(folder, error);
  throw StorageError("the disk failed to sync the files of the run, which starts over: check the disk");
}

Ending run_in_child(const JobRecord& job, const Isolation& isolation, const Watch& watch) {
  const std::filesystem::path folder = prepare_job_folder(isolation.jobs, job.folder);
  ChildProcess child(isolation.worker, run_job_option);
  child.send(
      describe({job.spec, job.cell_bundle, job.id, job.schedule.max_runtime_s, job.inherited, job.folder}, isolation));
  Conversation heard;
  Stopper stopper(watch.stop, isolation.cancel_grace);
  for (bool open = true; open;) {
    stopper.look(child);
    if (const std::optional<std::string> bytes = child.read(look_every)) {
      heard.hear(*bytes, watch);
      open = !bytes->empty();
    }
  }
  const std::string end = child.wait();
  if (heard.ending) return std::move(*heard.ending);
  if (end == failed_sync) start_over_after_failed_sync(folder);
  remove_drafts_in(folder);
  if (heard.let_go || stopper.asked()) throw Cancelled{};
  throw CrashError("the process that planned it ended with " + (end.empty() ? "exit code 0 and no result" : end));
}

// The child's words to its parent.
class Voice {
 public:
  Voice() : out_(take_output()) {}
  ~Voice() { std::fclose(out_); }
  Voice(const Voice&) = delete;
  Voice& operator=(const Voice&) = delete;

  void say(const Json& line) {
    const std::lock_guard lock(mutex_);
    say_line(line);
  }

  // Thinned: a stage's first, then every so often.
  void tell(const Progress& progress) {
    const std::lock_guard lock(mutex_);
    const auto now = Clock::now();
    if (progress.stage == stage_ && now - told_ < tell_every) return;
    told_ = now;
    stage_ = progress.stage;
    say_line({{"progress", progress_json(progress)}});
  }

 private:
  void say_line(const Json& line) {
    const std::string text = proto::write_json(line) + "\n";
    std::fwrite(text.data(), 1, text.size(), out_);
    std::fflush(out_);
  }

  std::mutex mutex_;
  std::FILE* out_;
  Clock::time_point told_;
  std::optional<Stage> stage_;
};

// SIGTERM becomes a wish to stop. Call before there are other threads, so that all of them leave the signal alone.
std::stop_token stop_on_signal() {
  sigset_t signals;
  ::sigemptyset(&signals);
  ::sigaddset(&signals, SIGTERM);
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::stop_source stop;
  std::thread([stop, signals]() mutable {
    int number = 0;
    ::sigwait(&signals, &number);
    stop.request_stop();
  }).detach();
  return stop.get_token();
}

}  // namespace

RunJob make_isolated_run(Isolation isolation) {
  return [isolation = std::move(isolation)](const JobRecord& job, const Watch& watch) {
    return run_in_child(job, isolation, watch);
  };
}

int run_isolated_job(const Planner& planner) {
  Voice voice;
  const std::optional<DescribedJob> described = take_description(std::cin);
  if (!described) return EXIT_FAILURE;
  std::optional<Ending> ending;
  try {
    const Job job = load_and_confine(*described, FolderUse::write);
    const Watch watch{stop_on_signal(), [&voice](const Progress& progress) { voice.tell(progress); }};
    ending = run_in_folder(described->job, job, described->folder(), planner, watch);
  } catch (...) {
    ending = caught_ending();
  }
  voice.say(ending ? Json{{"ending", to_json(*ending)}} : Json{{"let_go", true}});
  return EXIT_SUCCESS;
}

}  // namespace sculpt::server
