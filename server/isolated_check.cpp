#include "server/isolated_check.hpp"

#include <cstdio>
#include <iostream>
#include <new>

#include "server/child_process.hpp"
#include "server/job_run.hpp"

namespace sculpt {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds look_every{50};
constexpr std::size_t most_known = 10'000;

[[noreturn]] void refuse(const std::string& why) {
  throw InputError("mesh_unreadable", "the reader of its files " + why +
                                          ": the mesh is damaged in a way that it cannot take; repair it, or export it "
                                          "again as binary STL");
}

// All that the child says, until it ends.
std::string hear(ChildProcess& child, std::chrono::milliseconds patience, const std::stop_token& stop) {
  const auto end = Clock::now() + patience;
  std::string heard;
  while (true) {
    if (stop.stop_requested()) throw Cancelled{};
    if (Clock::now() > end)
      refuse("did not end within " +
             std::to_string(std::chrono::duration_cast<std::chrono::seconds>(patience).count()) + " s (check_s)");
    const std::optional<std::string> bytes = child.read(look_every);
    if (!bytes) continue;
    if (bytes->empty()) return heard;
    heard += *bytes;
  }
}

}  // namespace

std::string KnownFiles::files_of(const JobSpec& spec) {
  return spec.mesh.sha256 + " " + spec.mesh.name + " " +
         (spec.stock_mesh ? spec.stock_mesh->sha256 + " " + spec.stock_mesh->name : "") + " " + spec.cell_bundle;
}

bool KnownFiles::has(const JobSpec& spec) const {
  const std::lock_guard lock(mutex_);
  return files_.contains(files_of(spec));
}

void KnownFiles::add(const JobSpec& spec) {
  const std::lock_guard lock(mutex_);
  if (files_.size() >= most_known) files_.clear();
  files_.insert(files_of(spec));
}

void check_in_child(const StoredSpec& stored, const Isolation& isolation, std::chrono::milliseconds patience,
                    const std::stop_token& stop) {
  ChildProcess child(isolation.worker, check_job_option);
  child.send(describe(stored, isolation));
  const std::string heard = hear(child, patience, stop);
  const std::string end = child.wait();
  if (heard.empty()) refuse("ended with " + (end.empty() ? "no word" : end));
  const Json said = parse_json(heard);
  if (said.contains("code")) throw InputError(said.at("code"), said.at("sentence").get<std::string>());
}

int run_isolated_check(const Planner& planner) {
  std::FILE* out = take_output();
  const DescribedJob described = take_description(std::cin);
  Json said = Json::object();
  try {
    const Blobs blobs(described.blobs, 0);
    planner.check(to_job(read_stored_spec(described.job), described.job.cell_bundle, blobs, described.defaults), {});
  } catch (const InputError& error) {
    said = {{"code", error.code()}, {"sentence", error.what()}};
  } catch (const std::bad_alloc&) {
    said = {{"code", "out_of_memory"}, {"sentence", "there is not enough memory to read the mesh: use a smaller one"}};
  }
  std::fputs(write_json(said).c_str(), out);
  std::fclose(out);
  return EXIT_SUCCESS;
}

}  // namespace sculpt
