// Submit a mesh, wait, look at the figures, fetch the trajectory.
//   01_plan SERVER MESH OUT
#include <filesystem>
#include <fstream>
#include <iostream>

#include "clients/cpp/client.hpp"

int main(int count, char** arguments) {
  if (count != 4) return std::cerr << "usage: 01_plan SERVER MESH OUT\n", 2;
  sculpt::client::Client client(arguments[1], "01_plan");

  // The server keeps files by their content: a mesh that it has is not sent again.
  const std::string mesh = client.upload_file(arguments[2]);
  const std::string name = std::filesystem::path(arguments[2]).filename();
  const sculpt::Json spec{{"mesh", {{"blob", mesh}, {"name", name}}}, {"resolution", 16}, {"robot", "gantry"}};
  // With a key of your own the request may be repeated after a broken connection: the job is queued once.
  const std::string job = client.call("job.submit", {{"spec", spec}, {"key", mesh}}).at("job");

  sculpt::Json state;
  do state = client.call("job.wait", {{"job", job}, {"timeout_s", 60}});
  while (!sculpt::client::is_final(state.at("state")));
  if (state.at("state") != "succeeded") return std::cerr << state.dump(2) << "\n", 1;

  const sculpt::Json report = client.call("job.report", {{"job", job}});
  std::cout << "removed " << report.at("voxels").at("removed") << " of " << report.at("voxels").at("remove")
            << " voxels\n"
            << "keyframes " << report.at("path").at("keyframes") << "\n";
  std::ofstream out(arguments[3], std::ios::binary);
  client.read_artifact({job, "trajectory", "ndjson"}, out);
}
