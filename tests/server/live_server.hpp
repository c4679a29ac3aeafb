// A whole server in this process, on a free port, with the fake planner.
#pragma once

#include <optional>
#include <string>
#include <thread>

#include "clients/cpp/client.hpp"
#include "server/server.hpp"
#include "tests/server/fake_planner.hpp"
#include "tests/server/temp_folder.hpp"

namespace sculpt::server {

class LiveServer {
 public:
  explicit LiveServer(const std::function<void(Config&)>& change = {});
  ~LiveServer() { stop(); }
  LiveServer(const LiveServer&) = delete;
  LiveServer& operator=(const LiveServer&) = delete;

  FakePlanner fake;

  std::string address() const { return "127.0.0.1:" + std::to_string(server_->port()); }
  client::Client connect() const { return client::Client(address(), "test", {}, 0); }
  const std::filesystem::path& data() const { return folder_.path(); }
  /// The folder of a job's files.
  std::filesystem::path results(const std::string& job) const;
  void stop();
  /// The same data folder under a new server.
  void restart(const std::function<void(Config&)>& change = {});

 private:
  void start();

  TempFolder folder_;
  Config config_;
  std::optional<Server> server_;
  std::jthread thread_;
};

/// Uploads the wish (see fake_planner.hpp) as a mesh.
Json make_spec(client::Client& client, const std::string& wish);
/// Uploads, submits and gives the job's id.
std::string submit(client::Client& client, const std::string& wish);
/// Waits until the job is in a final state and gives it.
std::string final_state(client::Client& client, const std::string& job);
/// Waits (by events) until the job is in the state.
void await_state(client::Client& client, const std::string& job, const std::string& state);
/// The word of the error that a call is refused with, or "accepted".
std::string refusal(client::Client& client, const std::string& method, const Json& params);
/// A connection that has said hello, for lines that Client would never send.
void say_hello(client::Connection& connection);
/// The word of the next line's error, or the line itself.
std::string read_error(client::Connection& connection);

}  // namespace sculpt::server
