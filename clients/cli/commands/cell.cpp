// sculpt cell: what a cell is made of, what is wrong with it, and the cure.
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <thread>

#include "clients/cli/cell/cell_table.hpp"
#include "clients/cli/cell/png_file.hpp"
#include "clients/cli/commands/commands.hpp"
#include "clients/cli/exit_code.hpp"
#include "clients/cli/files.hpp"
#include "clients/cli/interrupt.hpp"
#include "clients/cli/job_options.hpp"
#include "clients/cli/uploads.hpp"
#include "core/doctor/draw_cell.hpp"
#include "core/doctor/examine.hpp"
#include "core/doctor/findings_json.hpp"
#include "core/material/resolution.hpp"

namespace sculpt::cli {

namespace {

struct CellOptions {
  std::string cell, picture;
  int resolution = 64;
  bool json = false;
};

constexpr std::uint64_t seed = 0;

CellFindings examine_here(const CellOptions& options) {
  std::stop_source stop;
  const Interrupt interrupt([&stop] { stop.request_stop(); });
  const Watch watch{stop.get_token(), {}};
  const Helpers helpers(static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
  try {
    const CellFiles files = read_cell(options.cell);
    const CellDraft draft = draft_cell(files);
    ExamineSettings settings{options.resolution};
    settings.store = {cache_folder(), field_key(files, options.resolution, seed)};
    CellFindings found = examine_cell(draft, settings, {seed, helpers, watch});
    if (!options.picture.empty())
      write_png(options.picture, draw_cell(draft.cell, draft.cell.home(draft.cell.chain()), found.home.bodies));
    return found;
  } catch (const InputError& error) {
    if (error.code() == "cell_unknown") throw;
    return unreadable_cell(options.cell, error);
  }
}

/// A name is the server's to resolve; a path is read here and sent.
Json examine_there(const std::string& server, const CellOptions& options) {
  if (!options.picture.empty())
    throw Failure(exit_usage, "usage", "a picture is drawn here, not by a server: leave out --server or --picture");
  std::optional<CellFiles> files;
  if (is_cell_path(options.cell)) files = read_cell(options.cell);
  client::Client client = connect(server);
  const Json robot = files ? upload_cell(client, *files) : Json(options.cell);
  return client.call("cell.check", {{"robot", robot}, {"resolution", options.resolution}});
}

int run_cell(const std::optional<std::string>& server, const CellOptions& options) {
  if (options.cell.empty())
    throw Failure(exit_usage, "usage", "name a cell, or `new` and a URDF (see sculpt cell --help)");
  check_resolution(options.resolution);
  const Json found = server ? examine_there(*server, options) : proto::parse_json(findings_json(examine_here(options)));
  std::cout << (options.json ? proto::write_json(found) + "\n" : cell_table(found));
  return found.at("plannable").get<bool>() ? exit_fine : exit_failed;
}

}  // namespace

void add_cell(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<CellOptions>();
  CLI::App& command = add_command(
      app, invocation, "cell",
      "Say what a cell is made of, what is wrong with it, and the cure: here, or with --server there, where "
      "a name is one of the server's cells",
      {});
  command.final_callback([&app, &command, &invocation, options] {
    if (!command.get_subcommands().empty()) return;
    std::optional<std::string> server;
    if (app.count("--server") + command.count("--server") > 0) server = invocation.server;
    invocation.run = [server, options] { return run_cell(server, *options); };
  });
  command.require_subcommand(0, 1);
  command.add_option("cell", options->cell, "The cell: a name under config/cells, or the path of a cell file")
      ->type_name("CELL");
  command.add_option("--resolution", options->resolution, "Voxels along each edge, for a tool that follows them")
      ->type_name("N")
      ->capture_default_str();
  command.add_flag("--json", options->json, "Print the findings as one JSON document");
  command.add_option("--picture", options->picture, "Draw the cell at home, what is in the way in red")
      ->type_name("FILE.png");
  add_cell_new(command, invocation);
}

}  // namespace sculpt::cli
