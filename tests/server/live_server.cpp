#include "tests/server/live_server.hpp"

#include <spdlog/spdlog.h>

#include "tests/server/test_store.hpp"

namespace sculpt::server {

LiveServer::LiveServer(const std::function<void(Config&)>& change) {
  spdlog::set_level(spdlog::level::off);
  config_.port = 0;
  config_.workers = 2;
  config_.data = folder_.path();
  config_.worker = FAKE_WORKER;
  config_.isolate = false;  // so that `fake` plans
  if (test_in_postgres()) {
    config_.store = test_database(folder_.path());
    config_.shared = folder_.path();
    config_.lease = std::chrono::seconds(30);
  }
  if (change) change(config_);
  start();
}

void LiveServer::start() {
  server_.emplace(config_, fake.planner());
  thread_ = std::jthread([this] { server_->run(); });
}

// Of its one attempt, where each has its own.
std::filesystem::path LiveServer::results(const std::string& job) const {
  const std::filesystem::path folder = data() / "jobs" / job;
  return test_in_postgres() ? std::filesystem::directory_iterator(folder)->path() : folder;
}

void LiveServer::stop() {
  if (!server_) return;
  server_->stop();
  thread_.join();
  server_.reset();
}

void LiveServer::restart(const std::function<void(Config&)>& change) {
  stop();
  if (change) change(config_);
  start();
}

Json make_spec(client::Client& client, const std::string& wish) {
  return {{"mesh", {{"blob", client.upload(wish)}, {"name", "wish.stl"}}}, {"robot", "gantry"}, {"resolution", 8}};
}

std::string submit(client::Client& client, const std::string& wish) {
  return client.call("job.submit", {{"spec", make_spec(client, wish)}}).at("job");
}

std::string final_state(client::Client& client, const std::string& job) {
  return client.call("job.wait", {{"job", job}, {"timeout_s", 86400}}).at("state");
}

void await_state(client::Client& client, const std::string& job, const std::string& state) {
  client.subscribe(job);
  while (true) {
    const Json event = *client.next_event();
    if (event.at("job") == job && event.at("type") == "state" && event.at("data").at("to") == state) break;
  }
  client.unsubscribe(job);
}

std::string refusal(client::Client& client, const std::string& method, const Json& params) {
  try {
    client.call(method, params);
    return "accepted";
  } catch (const client::ServerError& error) {
    return error.code();
  }
}

void say_hello(client::Connection& connection) {
  connection.send("{\"id\":0,\"method\":\"hello\",\"params\":{\"protocol\":[1,0],\"client\":\"test\"}}\n");
  connection.read_line();
}

std::string read_error(client::Connection& connection) {
  const std::string line = *connection.read_line();
  const Json reply = proto::parse_json(line);
  return reply.contains("error") ? reply["error"]["data"]["code"].get<std::string>() : line;
}

}  // namespace sculpt::server
