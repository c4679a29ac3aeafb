// Where the checkpoints of one run are kept.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "core/plan/checkpoint/checkpoint.hpp"

namespace sculpt {

/// The last two, so that a damaged one costs no more than an interval. Not shared between threads.
class CheckpointFolder {
 public:
  /// Keeps nothing and has nothing.
  CheckpointFolder() = default;
  /// Checkpoints of `key` in an existing folder, beside the trajectory they are about.
  CheckpointFolder(std::filesystem::path folder, std::filesystem::path trajectory, std::string key,
                   std::chrono::duration<double> interval);

  /// The last one that is undamaged, of the same key, and true of the trajectory file. What was there is forgotten if
  /// there is none.
  std::optional<Checkpoint> find_newest();

  bool keeps() const { return !folder_.empty(); }
  /// The last one is older than the interval.
  bool due() const;
  /// Durable at return; what it says of the trajectory file must be so already. Throws InputError `file_unwritable`.
  void save(const Checkpoint& checkpoint);

 private:
  std::filesystem::path file(std::uint64_t number) const;
  bool is_true_of_trajectory(const TrajectoryStart& start) const;

  std::filesystem::path folder_, trajectory_;
  std::string key_;
  std::chrono::duration<double> interval_{0};
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::uint64_t next_ = 0;
};

/// Takes the checkpoints out of a folder: the run is over.
void remove_checkpoints(const std::filesystem::path& folder);

}  // namespace sculpt
