// Progress for people: a bar that redraws itself on a terminal, else plain lines.
#pragma once

#include <chrono>
#include <cstdint>
#include <iosfwd>
#include <mutex>
#include <string>

namespace sculpt {

/// May be told from several threads.
class ProgressLine {
 public:
  /// `file_descriptor`: 1 or 2; a bar is drawn only where it is a terminal. `plain`: whether there are lines elsewhere.
  ProgressLine(int file_descriptor, bool plain);
  ~ProgressLine();

  /// At most ten redraws a second; plain lines only when the stage or the tenth of the way changes.
  void tell(const std::string& stage, std::uint64_t done, std::uint64_t total);
  /// A line that stays, e.g. a change of state.
  void say(const std::string& line);
  /// Wipes the bar, if there is one.
  void clear();

 private:
  void write(const std::string& text);

  const int file_descriptor_;
  const bool bar_, plain_;
  std::mutex mutex_;
  std::chrono::steady_clock::time_point drawn_at_{};
  std::string stage_;
  std::uint64_t tenth_ = 0;
  bool on_screen_ = false;
};

}  // namespace sculpt
