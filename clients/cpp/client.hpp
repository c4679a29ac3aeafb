// A connection to sculptd, used one call at a time: what the command line needs, and a start for other C++ programs.
//
//   Client client("127.0.0.1:7878", "example/1.0");
//   const std::string mesh = client.upload_file("david.stl");
//   const Json job = client.call("job.submit", {{"spec", {{"mesh", {{"blob", mesh}, {"name", "david.stl"}}}, ...}}});
//   client.read_artifact({job.at("job"), "trajectory"}, file);
#pragma once

#include <cstdint>
#include <deque>
#include <exception>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "clients/cpp/connection.hpp"
#include "proto/json.hpp"

namespace sculpt::client {

/// The server answered with an error of the catalogue (proto/PROTOCOL.md section 6); what() is its sentence.
class ServerError : public std::runtime_error {
 public:
  ServerError(std::string code, int number, bool retryable, std::string pointer, const std::string& sentence)
      : std::runtime_error(sentence),
        code_(std::move(code)),
        number_(number),
        retryable_(retryable),
        pointer_(std::move(pointer)) {}
  const std::string& code() const { return code_; }
  int number() const { return number_; }
  bool retryable() const { return retryable_; }
  /// Place of the field to blame in the request, or empty.
  const std::string& pointer() const { return pointer_; }

 private:
  std::string code_;
  int number_;
  bool retryable_;
  std::string pointer_;
};

/// Whether a job in this state has ended.
bool is_final(const std::string& state);

/// How long a client that has lost the server looks for it: SCULPT_PATIENCE_S, else a minute. Throws
/// std::runtime_error for what is no number of seconds.
double patience_from_environment();

struct ArtifactRequest {
  std::string job;
  std::string artifact;      ///< trajectory, timeline, voxels, stock, surface, residue, report, program
  std::string format = {};   ///< empty: the artifact's own
  std::uint64_t offset = 0;  ///< where to go on
  std::uint32_t chunk_bytes = 1 << 20;
  Json program = nullptr;  ///< of the artifact program: which one, as PROTOCOL.md says
};

struct JobCell {
  std::string name, cell_json;
  std::map<std::string, std::string> files;  ///< reference -> content
};

struct ListRequest {
  std::string after = {}, before = {};  ///< only jobs that were submitted between these two; empty: no bound
  bool newest = false;                  ///< the newest first
  std::size_t limit = 0;                ///< 0: all
};

/// Not shared between threads. When the connection breaks, or the server is about to stop, it is looked for until
/// `patience_s` is over; then what was asked is asked again, and subscriptions go on behind the last event: none is
/// lost and none comes twice. What must not be asked twice (job.submit without a key, job.retry) is not. Every method
/// throws ServerUnreachable when that fails, and ServerError when the server refuses or its store was replaced
/// (`replay_gap`).
class Client {
 public:
  /// Connects ("HOST:PORT", "[V6]:PORT", "tls:HOST:PORT", "unix:PATH") and says hello, without patience. `name` is for
  /// the server's log.
  Client(std::string server, std::string name, Login login = login_from_environment(),
         double patience_s = patience_from_environment());
  ~Client();
  Client(Client&&) noexcept;

  /// `tell` gets a sentence each time that the server is lost.
  void when_lost(std::function<void(const std::string&)> tell) { tell_lost_ = std::move(tell); }

  /// The reply to hello: server, epoch, features, limits.
  const Json& hello() const { return hello_; }

  /// Sends a request and waits for its result. Events that arrive meanwhile are kept for next_event.
  Json call(const std::string& method, const Json& params = Json::object());

  /// The reply to job.list, of as many pages as it takes: jobs, more, last, and damaged if there are any.
  Json list(const ListRequest& request = {});

  /// Uploads the content, unless the server has it, and returns its sha256. Goes on where an earlier upload stopped.
  std::string upload(std::string_view bytes);
  /// The same for a file. Throws std::runtime_error naming the path when it cannot be read.
  std::string upload_file(const std::filesystem::path& path);

  /// Writes the artifact from the offset to its end to `out` and returns the offset behind the last byte. Follows an
  /// artifact that still grows until it is final or the job ended without it; `waiting` (if given) is called when it
  /// has caught up, and ends the reading by returning false. Read from its start to its end it is held against the hash
  /// that the server stored: ServerError `artifact_damaged` when it has another.
  std::uint64_t read_artifact(const ArtifactRequest& request, std::ostream& out,
                              const std::function<bool()>& waiting = {});

  /// The cell that a job was submitted with, and its files by the name that the cell has for each, every one held
  /// against its hash.
  JobCell read_cell(const std::string& job);

  /// Events of a job from behind `after` on (0 = all), to be read with next_event.
  void subscribe(const std::string& job, std::uint64_t after = 0);
  void unsubscribe(const std::string& job);
  /// State events of all jobs from behind the one with this number on (0 = all; `last` of a list: what happens after
  /// it). They have a number, which those of `subscribe` have not.
  void subscribe_all(std::uint64_t after = 0);
  void unsubscribe_all();
  /// The params of the next event (job, type state|progress|live, seq?, number?, data?). Waits for it; with a timeout
  /// returns nothing when none came in time.
  std::optional<Json> next_event(std::optional<double> timeout_s = {});

 private:
  /// A request with its chunk, and where the chunk of its reply goes.
  struct Exchange {
    const std::string& method;
    const Json& params;
    std::optional<std::string_view> chunk;
    std::string* reply_chunk = nullptr;
  };
  void open();
  void find_again(const std::exception_ptr& lost);
  /// Asks until there is an answer.
  Json exchange(const Exchange& exchange);
  Json ask(const Exchange& exchange);
  void keep(Json event);
  /// The next reply or event; nothing when none came in time.
  std::optional<Json> receive(std::optional<double> timeout_s, std::string* chunk);
  /// `last`: the reply to the last piece.
  void expect_hash(const ArtifactRequest& request, const Json& last, const std::string& sha256);
  /// A file of a job's cell, or for an empty hash the bundle that names them.
  std::string read_cell_file(const std::string& job, const std::string& sha256);
  /// Gives `size` bytes from the offset on, which hold until the next call.
  using ReadPiece = std::function<std::string_view(std::uint64_t offset, std::size_t size)>;
  void put_blob(const std::string& sha256, std::uint64_t size, const ReadPiece& read);
  void put_chunk(const std::string& sha256, std::uint64_t size, std::uint64_t& offset, std::string_view chunk);
  void follow(const std::string& job, std::uint64_t after);

  std::string server_, name_;
  Login login_;
  double patience_s_;
  std::function<void(const std::string&)> tell_lost_;
  std::unique_ptr<Connection> connection_;
  Json hello_;
  std::deque<Json> events_;
  std::map<std::string, std::uint64_t> followed_;  ///< job that has not ended, or all_jobs -> its last event that came
  std::int64_t last_id_ = 0;
};

}  // namespace sculpt::client
