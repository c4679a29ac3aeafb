#include "core/plan/checkpoint/checkpoint_folder.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <vector>

#include "core/base/durable_file.hpp"
#include "core/base/sha256.hpp"

namespace sculpt {
namespace {

namespace fs = std::filesystem;

constexpr std::array names{"checkpoint-0", "checkpoint-1"};
constexpr std::size_t read_bytes = 1 << 20;

std::string read_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

CheckpointFolder::CheckpointFolder(fs::path folder, fs::path trajectory, std::string key,
                                   std::chrono::duration<double> interval)
    : folder_(std::move(folder)), trajectory_(std::move(trajectory)), key_(std::move(key)), interval_(interval) {}

fs::path CheckpointFolder::file(std::uint64_t number) const {
  return folder_ / names[number % names.size()];
}

std::optional<Checkpoint> CheckpointFolder::find_newest() {
  if (!keeps()) return std::nullopt;
  std::vector<NumberedCheckpoint> found;
  for (const char* name : names)
    if (auto checkpoint = read_checkpoint(read_file(folder_ / name), key_)) found.push_back(std::move(*checkpoint));
  std::ranges::sort(found, std::greater{}, &NumberedCheckpoint::number);
  const auto newest = std::ranges::find_if(
      found, [this](const NumberedCheckpoint& one) { return is_true_of_trajectory(one.checkpoint.file); });
  if (newest == found.end()) {
    remove_checkpoints(folder_);
    return std::nullopt;
  }
  next_ = newest->number + 1;
  return std::move(newest->checkpoint);
}

bool CheckpointFolder::is_true_of_trajectory(const TrajectoryStart& start) const {
  std::ifstream in(trajectory_, std::ios::binary);
  Sha256 hash;
  std::vector<char> buffer(read_bytes);
  std::uint64_t left = start.bytes;
  while (left > 0 && in.read(buffer.data(), static_cast<std::streamsize>(std::min<std::uint64_t>(left, read_bytes)))) {
    hash.add({buffer.data(), static_cast<std::size_t>(in.gcount())});
    left -= static_cast<std::uint64_t>(in.gcount());
  }
  return left == 0 && hash.hex() == start.sha256;
}

bool CheckpointFolder::due() const {
  return keeps() && std::chrono::steady_clock::now() - last_ >= interval_;
}

void CheckpointFolder::save(const Checkpoint& checkpoint) {
  if (!keeps()) return;
  replace_file(file(next_), checkpoint_text(checkpoint, key_, next_));
  ++next_;
  last_ = std::chrono::steady_clock::now();
}

void remove_checkpoints(const fs::path& folder) {
  for (const char* name : names)
    for (const char* ending : {"", ".draft"}) {
      std::error_code ignored;
      fs::remove(folder / (name + std::string(ending)), ignored);
    }
}

}  // namespace sculpt
