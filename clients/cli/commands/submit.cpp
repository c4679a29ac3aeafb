// sculpt submit: uploads what the server does not have yet and queues the job.
#include <unistd.h>

#include <iostream>
#include <memory>

#include "clients/cli/commands/commands.hpp"
#include "clients/cli/exit_code.hpp"
#include "clients/cli/job_end.hpp"
#include "clients/cli/job_options.hpp"
#include "clients/cli/uploads.hpp"

namespace sculpt::cli {

namespace {

struct SubmitOptions {
  JobOptions job;
  std::optional<double> feed_m_s, rapid_m_s, keep_feed;
  std::string continued;  ///< the job that left its stock; empty: none
  std::optional<int> priority;
  std::string key, queue, not_before, start_by;
  std::optional<std::int64_t> max_runtime_s;
  bool wait = false;
  bool json = false;
};

Json triple(const Vec3& v) {
  return Json::array({v.x(), v.y(), v.z()});
}

Json placement_of(const PlacementOptions& options) {
  const Placement placement = to_placement(options);
  Json json{{"rotation_rad", triple(placement.rotation_rad)},
            {"offset_m", triple(placement.offset_m)},
            {"margin_m", placement.margin_m}};
  if (placement.scale_m) json["scale_m"] = *placement.scale_m;
  return json;
}

/// What was read from this disk before the connection is made: a mistyped path is found without a server.
struct Inputs {
  MeshFile mesh;
  Stock stock;
  std::optional<CellFiles> cell;
};

Inputs read_inputs(const JobOptions& options) {
  Inputs inputs{read_mesh_file(options.mesh, "mesh"), read_stock(options.placement), {}};
  if (is_cell_path(options.robot)) inputs.cell = read_cell(options.robot);
  return inputs;
}

Json make_spec(client::Client& client, const JobOptions& options, const Inputs& inputs) {
  Json spec{{"mesh", upload_mesh(client, inputs.mesh)}};
  spec["robot"] = inputs.cell ? upload_cell(client, *inputs.cell) : Json(options.robot);
  spec["resolution"] = options.resolution;
  if (!options.search.empty()) spec["search"] = options.search;
  spec["seed"] = options.seed;
  if (options.allow_freed) spec["allow_freed"] = true;
  if (const auto mill = read_mill_order(options.mill)) {
    spec["mill"] = {{"tools", mill->tools}, {"library", proto::parse_json(mill->library.json)}};
    spec["mill"]["tolerance_m"] = mill->tolerance_m;
    if (mill->scallop_m) spec["mill"]["scallop_m"] = *mill->scallop_m;
    if (mill->allowance_m) spec["mill"]["allowance_m"] = *mill->allowance_m;
  }
  return spec;
}

/// Where the mesh stands in which stock.
void add_placement(client::Client& client, const PlacementOptions& options, const Inputs& inputs, Json& spec) {
  spec["placement"] = placement_of(options);
  if (inputs.stock.box)
    spec["stock"]["box"] = {{"min_m", triple(inputs.stock.box->min_m)}, {"max_m", triple(inputs.stock.box->max_m)}};
  if (inputs.stock.mesh) spec["stock"]["mesh"] = upload_mesh(client, *inputs.stock.mesh);
}

/// Nothing where nothing is said of it.
void add_motion(const SubmitOptions& options, Json& spec) {
  if (options.feed_m_s) spec["motion"]["feed_m_s"] = *options.feed_m_s;
  if (options.rapid_m_s) spec["motion"]["rapid_m_s"] = *options.rapid_m_s;
  if (options.keep_feed) spec["motion"]["keep_feed"] = *options.keep_feed;
}

/// The other job says all of it but how the block is turned.
void add_continue(const SubmitOptions& options, Json& spec) {
  spec["continue"] = {{"job", options.continued},
                      {"rotation_rad", triple(to_placement(options.job.placement).rotation_rad)}};
}

int run_submit(const std::string& server, const SubmitOptions& options) {
  const Inputs inputs = read_inputs(options.job);
  client::Client client = connect(server);
  Json params;
  if (!options.key.empty()) params["key"] = options.key;
  if (options.priority) params["priority"] = *options.priority;
  if (!options.queue.empty()) params["queue"] = options.queue;
  if (!options.not_before.empty()) params["not_before"] = options.not_before;
  if (!options.start_by.empty()) params["start_by"] = options.start_by;
  if (options.max_runtime_s) params["max_runtime_s"] = *options.max_runtime_s;
  Json& spec = params["spec"] = make_spec(client, options.job, inputs);
  add_motion(options, spec);
  if (options.continued.empty())
    add_placement(client, options.job.placement, inputs, spec);
  else
    add_continue(options, spec);
  Json reply = client.call("job.submit", params);
  const std::string job = reply.at("job");

  int exit_code = exit_fine;
  if (!options.json) std::cout << job << std::endl;
  if (options.wait) {
    ProgressLine progress(STDERR_FILENO, PlainLines::on_change);
    if (options.json) progress.say("job " + job);
    const Json end = follow_job(client, job, progress);
    reply["state"] = end.at("state");
    exit_code = end_exit_code(end);
  }
  if (options.json) std::cout << proto::write_json(reply) << "\n";
  return exit_code;
}

}  // namespace

void add_submit(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<SubmitOptions>();
  CLI::App& command = add_command(app, invocation, "submit", "Send a mesh and queue a job; prints the job's id",
                                  [&invocation, options] { return run_submit(invocation.server, *options); });
  add_job_options(command, options->job);
  CLI::Option* continued =
      command
          .add_option(
              "--continue", options->continued,
              "Carve on in what this job left, clamped another time: --rotate turns the block, by quarters; the "
              "mesh stands in it as in that job")
          ->type_name("JOB");
  for (const char* placed : {"--scale", "--offset", "--margin", "--stock-box", "--stock"}) continued->excludes(placed);
  const char* motion = "Time";
  command
      .add_option("--feed", options->feed_m_s,
                  "Tell in the report how long the plan takes at this speed of the ball on cuts; milling tools go no "
                  "faster than their own")
      ->type_name("M_S")
      ->group(motion);
  command.add_option("--rapid", options->rapid_m_s, "The same on moves; 0.5")->type_name("M_S")->group(motion);
  command
      .add_option("--keep-feed", options->keep_feed, "Let the job fail unless every cut keeps this share of the feed")
      ->type_name("SHARE")
      ->group(motion);
  command
      .add_option("--priority", options->priority,
                  "Higher runs first, -100 to 100; a step is worth a minute of waiting")
      ->type_name("P");
  command.add_option("--queue", options->queue, "Let only daemons plan it that serve this queue")->type_name("NAME");
  command.add_option("--not-before", options->not_before, "Hold it until then, UTC: 2026-01-31T12:00:00Z")
      ->type_name("TIME");
  command.add_option("--start-by", options->start_by, "Let it expire if it has not started by then")->type_name("TIME");
  command.add_option("--max-runtime", options->max_runtime_s, "End a run that takes longer")->type_name("SECONDS");
  command.add_option("--key", options->key, "Your own name for this job: submitting it twice makes one job")
      ->type_name("KEY");
  command.add_flag("--wait", options->wait,
                   "Wait for the end, with progress on stderr; exit 0 only if the job succeeded");
  command.add_flag("--json", options->json, "Print {job, state, duplicate} as one JSON document");
}

}  // namespace sculpt::cli
