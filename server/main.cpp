// sculptd: reads flags and config, then serves until a signal comes.
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>
#include <sysexits.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <iostream>

#include "server/config.hpp"
#include "server/data_folder.hpp"
#include "server/job_store.hpp"
#include "server/listener.hpp"
#include "server/planner.hpp"
#include "server/server.hpp"
#include "server/token_command.hpp"
#include "server/version.hpp"

namespace {

using namespace sculpt;

constexpr int usage_error = 2;

struct Flags {
  std::string config, listen, data, unix_socket, tokens;
  int workers = 0;
  TokenCommand token;
};

// What is wrong with a listen address, or nothing.
std::string address_fault(const std::string& address) {
  try {
    Config ignored;
    set_listen(address, ignored);
    return {};
  } catch (const ConfigError& error) {
    return error.what();
  }
}

int parse_flags(int argc, char** argv, Flags& flags, bool& done) {
  CLI::App app{"sculptd: the plan server for robotic sculpting"};
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return std::string("sculptd: ") + error.what() + "; see --help\n";
  });
  app.set_version_flag("--version", server_name);
  app.add_option("--config", flags.config, "JSON file with settings (see config/server.json)");
  app.add_option("--listen", flags.listen, "HOST:PORT to listen on, default 127.0.0.1:7878; port 0 takes any free one")
      ->check(address_fault);
  app.add_option("--data", flags.data, "folder for jobs and results, default ~/.local/share/sculptd");
  app.add_option("--workers", flags.workers, "jobs that run at once, default one less than there are cores")
      ->check(CLI::Range(1, 1024));
  app.add_option("--unix", flags.unix_socket,
                 "path of a unix socket to listen on too; its peers need no token if they are "
                 "the same user or root");
  app.add_option("--tokens", flags.tokens, "file of the tokens that clients must show (see sculptd token --help)");
  add_token_command(app, flags.token);
  try {
    app.parse(argc, argv);
    done = false;
    return 0;
  } catch (const CLI::ParseError& error) {
    done = true;
    return app.exit(error) == 0 ? 0 : usage_error;
  }
}

Config make_config(const Flags& flags) {
  Config config = default_config();
  if (!flags.config.empty()) read_config(flags.config, config);
  if (!flags.listen.empty()) set_listen(flags.listen, config);
  if (!flags.data.empty()) config.data = flags.data;
  if (flags.workers > 0) config.workers = flags.workers;
  if (!flags.unix_socket.empty()) config.unix_socket = flags.unix_socket;
  if (!flags.tokens.empty()) config.tokens = flags.tokens;
  return config;
}

void start_log(const std::string& level) {
  auto log = spdlog::stderr_logger_mt("sculptd");
  log->set_pattern("%Y-%m-%dT%H:%M:%S.%e %l %v");
  log->set_level(spdlog::level::from_str(level));
  spdlog::set_default_logger(log);
}

// Every connection is a file; the usual soft limit of 1024 is for programs that use select.
void raise_file_limit() {
  rlimit files{};
  if (::getrlimit(RLIMIT_NOFILE, &files) != 0) return;
  files.rlim_cur = files.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &files);
}

void serve(const Config& config) {
  start_log(config.log);
  raise_file_limit();
  Server server(config, make_planner(config.cells));
  server.stop_on_signals();
  std::cout << server_name << " listening on " << server.host() << ":" << server.port() << std::endl;
  server.run();
}

int fail(int code, const char* sentence) {
  std::cerr << "sculptd: " << sentence << "\n";
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  Flags flags;
  bool done = false;
  if (const int code = parse_flags(argc, argv, flags, done); done) return code;
  // A peer that vanished shows as an error of the write.
  std::signal(SIGPIPE, SIG_IGN);
  try {
    const Config config = make_config(flags);
    if (flags.token.verb == TokenCommand::Verb::none) {
      serve(config);
    } else {
      run_token_command(flags.token, config.tokens, std::cout);
    }
    return EXIT_SUCCESS;
  } catch (const ConfigError& error) {
    return fail(EX_CONFIG, error.what());
  } catch (const DataFolderError& error) {
    return fail(EX_CANTCREAT, error.what());
  } catch (const StorageError& error) {
    return fail(EX_CANTCREAT, error.what());
  } catch (const ListenError& error) {
    return fail(EX_UNAVAILABLE, error.what());
  } catch (const std::exception& error) {
    return fail(EX_SOFTWARE, error.what());
  }
}
