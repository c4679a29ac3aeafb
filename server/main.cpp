// sculptd: settles the config, then shows it or serves until a signal comes.
#include <sys/resource.h>
#include <sys/stat.h>
#include <sysexits.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <optional>

#include "proto/version.hpp"
#include "server/access/token_command.hpp"
#include "server/base/config.hpp"
#include "server/base/crash_point.hpp"
#include "server/base/log.hpp"
#include "server/base/settings.hpp"
#include "server/base/settled_config.hpp"
#include "server/files/folder_lock.hpp"
#include "server/files/store_mark.hpp"
#include "server/listener.hpp"
#include "server/ops/folder_command.hpp"
#include "server/ops/migrate_command.hpp"
#include "server/results/isolated_program.hpp"
#include "server/results/isolated_timing.hpp"
#include "server/results/machined_files.hpp"
#include "server/run/isolated_check.hpp"
#include "server/run/isolated_examination.hpp"
#include "server/run/isolated_replay.hpp"
#include "server/run/isolated_run.hpp"
#include "server/run/planner.hpp"
#include "server/server.hpp"
#include "server/store/job_store.hpp"

namespace {

using namespace sculpt::server;
namespace proto = sculpt::proto;

constexpr int usage_error = 2;

struct CommandLine {
  ConfigSources sources;
  bool show_config = false, json = false;
  TokenCommand token;
  FolderCommand folder;
  MigrateCommand migrate;
};

// What is wrong with the text of a setting, or nothing.
std::string fault(const Setting& setting, const std::string& text) {
  try {
    Config ignored;
    read_setting(setting, text, ignored);
    return {};
  } catch (const ConfigError& error) {
    return error.what();
  }
}

void add_setting_flags(CLI::App& app, ConfigSources& sources) {
  for (const Setting& setting : settings()) {
    app.add_option_function<std::string>(
           flag_of(setting), [&](const std::string& text) { sources.flags[setting.name] = text; }, setting.help)
        ->type_name(setting.type)
        ->take_last()
        ->check([&](const std::string& text) { return fault(setting, text); });
  }
}

/// An exit code, or nothing when the daemon has something to do.
std::optional<int> parse_command_line(int argc, char** argv, CommandLine& line) {
  CLI::App app{"sculptd: the plan server for robotic sculpting", "sculptd"};
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return std::string("sculptd: ") + error.what() + "; see --help\n";
  });
  app.set_version_flag("--version", proto::server_name);
  app.add_option("--config", line.sources.file, "JSON file with settings; the flags below win over it")
      ->type_name("FILE");
  add_setting_flags(app, line.sources);
  app.fallthrough();
  CLI::App& config = *app.add_subcommand("config", "Print every setting with its value and where that comes from");
  config.add_flag("--json", line.json, "Print one JSON document");
  config.callback([&] { line.show_config = true; });
  add_token_command(app, line.token);
  add_folder_command(app, line.folder);
  add_migrate_command(app, line.migrate);
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : usage_error;
  }
}

// Every connection is a file; the usual soft limit of 1024 is for programs that use select.
void raise_file_limit() {
  rlimit files{};
  if (::getrlimit(RLIMIT_NOFILE, &files) != 0) return;
  files.rlim_cur = files.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &files);
}

void serve(const Config& config, const ConfigSources& sources) {
  constexpr mode_t others_and_group = 077;
  ::umask(others_and_group);
  start_log(config);
  raise_file_limit();
  Server server(config, make_planner(config.cells));
  server.stop_on_signals();
  server.reload_on_hangup([&sources] { return settle_config(sources).config; });
  std::cout << proto::server_name << " listening on " << server.host() << ":" << server.port() << std::endl;
  server.run();
}

void show(const SettledConfig& settled, bool json) {
  std::cout << (json ? proto::write_json(settings_json(settled)) + "\n" : settings_table(settled));
}

int run(const CommandLine& line, const SettledConfig& settled) {
  if (line.folder.verb != FolderCommand::Verb::none) {
    start_log(settled.config);
    return run_folder_command(line.folder, settled.config, std::cout);
  }
  if (line.show_config)
    show(settled, line.json);
  else if (line.token.verb != TokenCommand::Verb::none)
    run_token_command(line.token, settled.config.tokens, std::cout);
  else if (line.migrate.wanted)
    run_migrate_command(line.migrate, settled.config, std::cout);
  else
    serve(settled.config, line.sources);
  return EXIT_SUCCESS;
}

int fail(int code, const char* sentence) {
  std::cerr << "sculptd: " << sentence << "\n";
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view mode = argc == 2 ? argv[1] : "";
  if (mode == run_job_option) return run_isolated_job(make_planner({}));
  if (mode == check_job_option) return run_isolated_check(make_planner({}));
  if (mode == check_cell_option) return run_isolated_examination(make_planner({}));
  if (mode == replay_job_option) return run_isolated_replay(make_planner({}));
  if (mode == time_job_option) return run_isolated_timing(make_planner({}));
  if (mode == program_job_option) return run_isolated_program(make_planner({}));
  if (mode == machined_job_option) return run_isolated_machined(make_planner({}));
  CommandLine line;
  if (const std::optional<int> code = parse_command_line(argc, argv, line)) return *code;
  // A peer that vanished shows as an error of the write.
  std::signal(SIGPIPE, SIG_IGN);
  try {
    arm_crash_point(std::getenv("SCULPT_CRASH_AT"));
    return run(line, settle_config(line.sources));
  } catch (const ConfigError& error) {
    return fail(EX_CONFIG, error.what());
  } catch (const StoreLost& error) {
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
