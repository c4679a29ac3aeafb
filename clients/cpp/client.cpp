#include "clients/cpp/client.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>
#include <vector>

#include "proto/messages.hpp"
#include "proto/request.hpp"

namespace sculpt::client {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::size_t max_page = 1000;
constexpr std::chrono::milliseconds first_pause{100}, max_pause{2000};  // between looks for a lost server

[[noreturn]] void raise(const Json& error) {
  const Json data = error.value("data", Json::object());
  throw ServerError(data.value("code", std::string("internal_error")), error.value("code", 0),
                    data.value("retryable", false), data.value("pointer", std::string()),
                    error.value("message", std::string("the server gave an error without a message")));
}

// Stands for all jobs among those that are followed.
const std::string all_jobs;

Json subscription(const std::string& job) {
  Json params = Json::object();
  if (job != all_jobs) params["job"] = job;
  return params;
}

// Asking twice comes to the same as asking once.
bool may_repeat(const std::string& method, const Json& params) {
  return method != "job.retry" && (method != "job.submit" || params.contains("key"));
}

}  // namespace

bool is_final(const std::string& state) {
  return state == "succeeded" || state == "failed" || state == "quarantined" || state == "expired" ||
         state == "cancelled";
}

double patience_from_environment() {
  constexpr double usual_s = 60;
  const char* text = std::getenv("SCULPT_PATIENCE_S");
  if (text == nullptr || *text == '\0') return usual_s;
  char* end = nullptr;
  const double seconds = std::strtod(text, &end);
  if (*end != '\0' || !(seconds >= 0))
    throw std::runtime_error(std::string("SCULPT_PATIENCE_S must be a number of seconds, not '") + text + "'");
  return seconds;
}

Client::Client(std::string server, std::string name, Login login, double patience_s)
    : server_(std::move(server)), name_(std::move(name)), login_(std::move(login)), patience_s_(patience_s) {
  open();
}
Client::~Client() = default;
Client::Client(Client&&) noexcept = default;

void Client::open() {
  connection_ = std::make_unique<Connection>(server_, login_);
  const std::string method = "hello";
  Json hello{{"protocol", {proto::protocol_major, proto::protocol_minor}}, {"client", name_}};
  if (!login_.token.empty()) hello["token"] = login_.token;
  hello_ = ask({method, hello, {}, nullptr});
}

// Ends with a new connection, on which all is followed that was, or throws what was `lost` with.
void Client::find_again(const std::exception_ptr& lost) {
  const auto end = Clock::now() + std::chrono::duration<double>(patience_s_);
  if (patience_s_ > 0 && tell_lost_) tell_lost_("the connection to " + server_ + " broke: looking for the server");
  const std::string epoch = hello_.value("epoch", std::string());
  for (auto pause = first_pause; Clock::now() + pause < end; pause = std::min(2 * pause, max_pause)) {
    std::this_thread::sleep_for(pause);
    try {
      open();
      if (hello_.value("epoch", std::string()) != epoch) {
        throw ServerError("replay_gap", 6001, false, {},
                          "the store of the server at " + server_ + " was replaced: the jobs of before are not there");
      }
      const std::string method = "events.subscribe";
      for (const auto& [job, last] : followed_) {
        Json params = subscription(job);
        params["after"] = last;
        ask({method, params, {}, nullptr});
      }
      return;
    } catch (const ServerUnreachable&) {
    } catch (const ServerError& error) {
      if (error.code() != "stopping") throw;
    }
  }
  std::rethrow_exception(lost);
}

Json Client::call(const std::string& method, const Json& params) {
  return exchange({method, params, {}, nullptr});
}

Json Client::exchange(const Exchange& exchange) {
  while (true) {
    std::exception_ptr lost;
    try {
      return ask(exchange);
    } catch (const ServerUnreachable&) {
      lost = std::current_exception();
    } catch (const ServerError& error) {
      if (error.code() != "stopping") throw;
      lost = std::current_exception();
    }
    if (!may_repeat(exchange.method, exchange.params)) std::rethrow_exception(lost);
    find_again(lost);
  }
}

Json Client::ask(const Exchange& exchange) {
  const std::int64_t id = ++last_id_;
  std::string bytes = proto::request_line(id, exchange.method, exchange.params) + "\n";
  if (exchange.chunk) bytes.append(*exchange.chunk).append("\n");
  connection_->send(bytes);
  while (true) {
    Json message = *receive(std::nullopt, exchange.reply_chunk);
    if (message.contains("method")) {
      keep(std::move(message["params"]));
    } else if (message.contains("error")) {
      raise(message["error"]);
    } else if (message.value("id", Json()) == id) {
      return std::move(message["result"]);
    }
  }
}

std::optional<Json> Client::receive(std::optional<double> timeout_s, std::string* chunk) {
  const std::optional<std::string> line = connection_->read_line(timeout_s);
  if (!line) return std::nullopt;
  Json message;
  try {
    message = proto::parse_json(*line);
  } catch (const proto::JsonError& error) {
    throw ServerUnreachable(std::string("the server does not speak the protocol: ") + error.what());
  }
  if (!message.is_object()) throw ServerUnreachable("the server does not speak the protocol: a line is no object");
  if (chunk != nullptr && message.contains("result")) {
    *chunk = connection_->read_chunk(message["result"].value("bytes", std::size_t{0}));
  }
  return message;
}

Json Client::list(const ListRequest& request) {
  Json params{{"limit", max_page}};
  if (!request.after.empty()) params["after"] = request.after;
  if (!request.before.empty()) params["before"] = request.before;
  if (request.newest) params["order"] = "newest";
  Json jobs = Json::array(), damaged = Json::array(), last;
  bool more = true;
  while (more && (request.limit == 0 || jobs.size() < request.limit)) {
    if (request.limit != 0) params["limit"] = std::min(max_page, request.limit - jobs.size());
    const Json page = call("job.list", params);
    for (const Json& job : page.at("jobs")) jobs.push_back(job);
    for (const Json& job : page.value("damaged", Json::array())) damaged.push_back(job);
    if (last.is_null()) last = page.at("last");
    more = page.at("more").get<bool>() && !page.at("jobs").empty();
    if (!jobs.empty()) params[request.newest ? "before" : "after"] = jobs.back().at("job");
  }
  Json all{{"jobs", std::move(jobs)}, {"more", more}, {"last", std::move(last)}};
  if (!damaged.empty()) all["damaged"] = std::move(damaged);
  return all;
}

void Client::keep(Json event) {
  if (event.contains("number")) {
    followed_[all_jobs] = event.at("number");
  } else if (event.contains("seq")) {
    const std::string job = event.at("job");
    followed_[job] = event.at("seq");
    const std::string to = event.value("data", Json::object()).value("to", std::string());
    if (is_final(to)) followed_.erase(job);  // nothing more comes, and it may be gone by then
  }
  events_.push_back(std::move(event));
}

void Client::follow(const std::string& job, std::uint64_t after) {
  Json params = subscription(job);
  params["after"] = after;
  call("events.subscribe", params);
  followed_[job] = after;
}

void Client::subscribe(const std::string& job, std::uint64_t after) {
  follow(job, after);
}

void Client::subscribe_all(std::uint64_t after) {
  follow(all_jobs, after);
}

void Client::unsubscribe(const std::string& job) {
  call("events.unsubscribe", subscription(job));
  followed_.erase(job);
  std::erase_if(events_, [&](const Json& event) { return !event.contains("number") && event.value("job", "") == job; });
}

void Client::unsubscribe_all() {
  call("events.unsubscribe", subscription(all_jobs));
  followed_.erase(all_jobs);
  std::erase_if(events_, [](const Json& event) { return event.contains("number") || !event.contains("job"); });
}

std::optional<Json> Client::next_event(std::optional<double> timeout_s) {
  while (events_.empty()) {
    try {
      std::optional<Json> message = receive(timeout_s, nullptr);
      if (!message) return std::nullopt;
      if (message->contains("method")) keep(std::move((*message)["params"]));
    } catch (const ServerUnreachable&) {
      find_again(std::current_exception());
    }
  }
  Json event = std::move(events_.front());
  events_.pop_front();
  return event;
}

}  // namespace sculpt::client
