// What is said of cells.
#include "server/api/handlers.hpp"
#include "server/run/isolated_examination.hpp"

namespace sculpt::server {
namespace {

const std::string cell_pointer = "/params/robot/cell/blob";

/// The hash of the cell's bundle; a cell of the server is stored as one. Refuses what is too large to be read.
std::string find_bundle(const CellGroup& group, const proto::CellCheckParams& params) {
  std::string bundle = params.robot.bundle;
  if (bundle.empty()) bundle = store_cell(group.planner.read_cell(params.robot.name), group.blobs);
  JobSizes sizes;
  sizes.resolution = params.resolution;
  sizes.mesh.extension = "stl";  // there is none
  sizes.cell_bytes = measure_cell(bundle, group.blobs, cell_pointer);
  check_sizes(sizes, group.defaults.memory_cap_bytes);
  return bundle;
}

void examine(const CellGroup& group, std::shared_ptr<Call> call, const proto::CellCheckParams& params,
             const std::string& client) {
  std::string bundle;
  try {
    bundle = find_bundle(group, params);
  } catch (...) {
    return group.answers.with(std::move(call), []() -> Answer { throw; });
  }
  const std::chrono::milliseconds patience = group.config.check_time;
  group.checks.add(
      client, [group, call = std::move(call), bundle, params, patience](const std::stop_token& stop) mutable {
        group.answers.with(std::move(call), [&] {
          return Answer{examine_in_child(bundle, params.resolution, group.isolation, patience, stop), std::nullopt};
        });
      });
}

void on_check(const CellGroup& group, Call call) {
  const proto::CellCheckParams params = proto::read_cell_check(call.params);
  const std::string owner = call.session->owner();
  // Those who have no name are told apart by their connection.
  const std::string client =
      owner.empty() ? std::to_string(reinterpret_cast<std::uintptr_t>(call.session.get())) : owner;
  group.admission.add([group, call = std::make_shared<Call>(std::move(call)), params,
                       client](const std::stop_token&) mutable { examine(group, std::move(call), params, client); });
}

}  // namespace

Handlers cell_handlers(const CellGroup& group) {
  return {
      {"cell.check", [group](Call call) { on_check(group, std::move(call)); }},
  };
}

}  // namespace sculpt::server
