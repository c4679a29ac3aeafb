// sculptd: reads flags and config, then serves until a signal comes.
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <sysexits.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <iostream>

#include "server/config.hpp"
#include "server/data_folder.hpp"
#include "server/isolated_run.hpp"
#include "server/job_store.hpp"
#include "server/listener.hpp"
#include "server/planner.hpp"
#include "server/server.hpp"
#include "server/version.hpp"

namespace {

using namespace sculpt;

constexpr int usage_error = 2;

struct Flags {
  std::string config, listen, data;
  int workers = 0;
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
  return config;
}

void start_log(const std::string& level) {
  auto log = spdlog::stderr_logger_mt("sculptd");
  log->set_pattern("%Y-%m-%dT%H:%M:%S.%e %l %v");
  log->set_level(spdlog::level::from_str(level));
  spdlog::set_default_logger(log);
}

void serve(const Config& config) {
  start_log(config.log);
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
  if (argc == 2 && std::string_view(argv[1]) == run_job_option) return run_isolated_job(make_planner({}));
  Flags flags;
  bool done = false;
  if (const int code = parse_flags(argc, argv, flags, done); done) return code;
  // A peer that vanished shows as an error of the write.
  std::signal(SIGPIPE, SIG_IGN);
  try {
    serve(make_config(flags));
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
