// sculpt cancel, pause, resume, retry, pin, queue: one order, one answer.
#include <iostream>
#include <memory>

#include "clients/cli/commands/commands.hpp"
#include "clients/cli/exit_code.hpp"
#include "clients/cpp/client.hpp"

namespace sculpt::cli {

namespace {

struct Order {
  std::string job;
  bool json = false;
};

int give_order(const std::string& server, const std::string& method, const Order& order) {
  client::Client client = connect(server);
  const Json reply = client.call(method, {{"job", order.job}});
  std::cout << (order.json ? proto::write_json(reply) : reply.at("state").get<std::string>()) << "\n";
  return exit_fine;
}

void add_order(CLI::App& app, Invocation& invocation, const std::string& verb, const std::string& description) {
  const auto order = std::make_shared<Order>();
  CLI::App& command = add_command(app, invocation, verb, description, [&invocation, verb, order] {
    return give_order(invocation.server, "job." + verb, *order);
  });
  command.add_option("job", order->job, "The id that submit printed")->type_name("JOB")->required();
  command.add_flag("--json", order->json, "Print {job, state} as one JSON document");
}

int pin_job(const std::string& server, const Order& order, bool pinned) {
  client::Client client = connect(server);
  const Json reply = client.call("artifact.pin", {{"job", order.job}, {"pinned", pinned}});
  std::cout << (order.json ? proto::write_json(reply) : pinned ? "pinned" : "not pinned") << "\n";
  return exit_fine;
}

int set_queue(const std::string& server, const std::string& wish, bool json) {
  client::Client client = connect(server);
  const Json reply = client.call("queue." + wish, Json::object());
  std::cout << (json ? proto::write_json(reply) : reply.at("paused").get<bool>() ? "paused" : "open") << "\n";
  return exit_fine;
}

}  // namespace

void add_cancel(CLI::App& app, Invocation& invocation) {
  add_order(app, invocation, "cancel", "Stop a job, waiting or running, for good");
}

void add_pause(CLI::App& app, Invocation& invocation) {
  add_order(app, invocation, "pause", "Stop a job, waiting or running, until it is resumed");
}

void add_resume(CLI::App& app, Invocation& invocation) {
  add_order(app, invocation, "resume", "Queue a paused job again");
}

void add_retry(CLI::App& app, Invocation& invocation) {
  add_order(app, invocation, "retry", "Queue a quarantined job again, or one whose result was damaged on disk");
}

void add_pin(CLI::App& app, Invocation& invocation) {
  const auto order = std::make_shared<Order>();
  const auto off = std::make_shared<bool>(false);
  CLI::App& command = add_command(app, invocation, "pin", "Keep a job and its results for ever",
                                  [&invocation, order, off] { return pin_job(invocation.server, *order, !*off); });
  command.add_option("job", order->job, "The id that submit printed")->type_name("JOB")->required();
  command.add_flag("--off", *off, "Keep it no longer than others");
  command.add_flag("--json", order->json, "Print {job, pinned} as one JSON document");
}

void add_queue(CLI::App& app, Invocation& invocation) {
  const auto wish = std::make_shared<std::string>();
  const auto json = std::make_shared<bool>(false);
  CLI::App& command = add_command(app, invocation, "queue", "Let no more jobs start, or let them start again",
                                  [&invocation, wish, json] { return set_queue(invocation.server, *wish, *json); });
  command.add_option("what", *wish, "pause or resume")->required()->check(CLI::IsMember({"pause", "resume"}));
  command.add_flag("--json", *json, "Print {paused} as one JSON document");
}

}  // namespace sculpt::cli
