// One entry per command: each adds its sub-command to the app and sets `run` when it is the one that was given.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "clients/cpp/client.hpp"

namespace sculpt::cli {

/// What the command line decided: where the server is and what to do.
struct Invocation {
  std::string server;        ///< HOST:PORT
  std::function<int()> run;  ///< the command; gives the exit code, or throws Failure, InputError...
};

/// Says on stderr when the server is lost and looked for.
client::Client connect(const std::string& server);

/// --server and --version, which stand before or after the command's name.
void add_common_options(CLI::App& command, Invocation& invocation);

/// A sub-command with the options that all of them take. `run` becomes the invocation's.
CLI::App& add_command(CLI::App& app, Invocation& invocation, const std::string& name, const std::string& description,
                      std::function<int()> run);

void add_submit(CLI::App& app, Invocation& invocation);
void add_list(CLI::App& app, Invocation& invocation);
void add_status(CLI::App& app, Invocation& invocation);
void add_top(CLI::App& app, Invocation& invocation);
void add_watch(CLI::App& app, Invocation& invocation);
void add_wait(CLI::App& app, Invocation& invocation);
void add_cancel(CLI::App& app, Invocation& invocation);
void add_pause(CLI::App& app, Invocation& invocation);
void add_resume(CLI::App& app, Invocation& invocation);
void add_retry(CLI::App& app, Invocation& invocation);
void add_pin(CLI::App& app, Invocation& invocation);
void add_queue(CLI::App& app, Invocation& invocation);
void add_report(CLI::App& app, Invocation& invocation);
void add_fetch(CLI::App& app, Invocation& invocation);
void add_link(CLI::App& app, Invocation& invocation);
void add_render(CLI::App& app, Invocation& invocation);
void add_verify(CLI::App& app, Invocation& invocation);
void add_voxelize(CLI::App& app, Invocation& invocation);
void add_plan(CLI::App& app, Invocation& invocation);
void add_cell(CLI::App& app, Invocation& invocation);
void add_cell_new(CLI::App& cell, Invocation& invocation);
void add_place(CLI::App& app, Invocation& invocation);
void add_time(CLI::App& app, Invocation& invocation);
void add_sample(CLI::App& app, Invocation& invocation);
void add_program(CLI::App& app, Invocation& invocation);
void add_completion(CLI::App& app, Invocation& invocation);

}  // namespace sculpt::cli
