#include "server/queue/passed_checks.hpp"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "core/base/content_key.hpp"
#include "core/base/sha256.hpp"

namespace sculpt::server {
namespace {

constexpr std::size_t max_kept = 1'000'000;  // 65 MB; then it begins anew
constexpr std::size_t key_digits = 64;

bool is_key(const std::string& line) {
  return line.size() == key_digits && line.find_first_not_of("0123456789abcdef") == std::string::npos;
}

bool write_line(const std::filesystem::path& path, const std::string& line, int how) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW | how, 0600);
  if (file < 0) return false;
  const bool done = ::write(file, line.data(), line.size()) == static_cast<ssize_t>(line.size());
  ::close(file);
  return done;
}

// All of a file's name that matters.
std::string nameless(const std::string& name) {
  return std::string(".").append(mesh_kind(name));
}

}  // namespace

std::string check_key(const proto::JobSpec& spec, const std::string& cell_bundle, const JobDefaults& defaults) {
  proto::JobSpec checked = spec;
  checked.seed = 0;
  checked.threads.reset();
  checked.robot.clear();
  checked.cell_bundle = cell_bundle;
  checked.mesh.name = nameless(spec.mesh.name);
  if (checked.stock_mesh) checked.stock_mesh->name = nameless(spec.stock_mesh->name);
  Sha256 hash;
  for (const std::string& field : {program_hash(), std::string("check"), proto::write_json(to_json(checked)),
                                   std::to_string(defaults.memory_cap_bytes)}) {
    hash.add(std::to_string(field.size()) + ":");  // where one ends, whatever is in it
    hash.add(field);
  }
  return hash.hex();
}

PassedChecks::PassedChecks(std::filesystem::path file) : file_(std::move(file)) {
  std::ifstream in(file_);
  for (std::string line; std::getline(in, line);)
    if (is_key(line)) keys_.insert(line);
}

bool PassedChecks::has(const std::string& key) const {
  const std::lock_guard lock(mutex_);
  return keys_.contains(key);
}

void PassedChecks::add(const std::string& key) {
  const std::lock_guard lock(mutex_);
  const bool anew = keys_.size() >= max_kept;
  if (anew) keys_.clear();
  if (!keys_.insert(key).second) return;
  // Behind a line that a crash cut off.
  if (!write_line(file_, "\n" + key + "\n", anew ? O_TRUNC : 0))
    spdlog::warn("'{}' cannot be written ({}): checks are remembered until the daemon ends", file_.string(),
                 std::strerror(errno));
}

}  // namespace sculpt::server
