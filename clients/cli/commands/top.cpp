// sculpt top: the queue and what runs, live.
#include <atomic>
#include <iostream>
#include <memory>
#include <optional>

#include "clients/cli/commands/commands.hpp"
#include "clients/cli/exit_code.hpp"
#include "clients/cli/interrupt.hpp"
#include "clients/cli/queue_view.hpp"
#include "clients/cli/screen.hpp"
#include "proto/version.hpp"

namespace sculpt::cli {

namespace {

constexpr std::chrono::milliseconds redraw_time{1000};

struct TopOptions {
  bool once = false;
  bool json = false;
};

int print_snapshot(const std::string& server, bool json) {
  client::Client client = connect(server);
  OpenJobs jobs;
  const Json queue = read_queue(client, jobs);
  std::cout << (json ? proto::write_json(queue) + "\n" : queue_text(queue, 0, 0));
  return exit_fine;
}

/// A server that is started again is found again.
class Queue {
 public:
  explicit Queue(const std::string& server) : server_(server) { open(); }

  std::string text(Screen::Size size) try {
    if (!client_) open();
    // The last line stays free, so that the terminal does not scroll.
    return queue_text(read_queue(*client_, jobs_), size.columns, std::max(2, size.rows - 1));
  } catch (const client::ServerUnreachable& error) {
    client_.reset();
    jobs_ = {};
    return std::string(error.what()).substr(0, static_cast<std::size_t>(size.columns)) + "\n";
  }

 private:
  // Without patience: what the screen shows is never old.
  void open() { client_.emplace(server_, proto::client_name, client::login_from_environment(), 0); }

  std::string server_;
  std::optional<client::Client> client_;
  OpenJobs jobs_;
};

int show_live(const std::string& server) {
  std::atomic<bool> stop = false;
  const Interrupt interrupt([&stop] { stop = true; });
  Queue queue(server);
  Screen screen;
  do {
    screen.draw(queue.text(screen.size()));
  } while (!stop && !screen.quit_pressed(redraw_time));
  return exit_fine;
}

}  // namespace

void add_top(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<TopOptions>();
  CLI::App& command =
      add_command(app, invocation, "top", "The queue and what runs, live in the terminal until q or Ctrl-C is pressed",
                  [&invocation, options] {
                    const bool live = !options->once && !options->json && Screen::is_there();
                    return live ? show_live(invocation.server) : print_snapshot(invocation.server, options->json);
                  });
  command.add_flag("--once", options->once, "Print it once and end, as where there is no terminal");
  command.add_flag("--json", options->json, "Print it once as one JSON document");
}

}  // namespace sculpt::cli
