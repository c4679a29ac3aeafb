// Progress for people: a bar that redraws itself on a terminal, else plain lines.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>

namespace sculpt::cli {

/// What is written where there is no terminal.
enum class PlainLines {
  none,
  on_change,    ///< a line whenever the stage or the tenth of the way changes
  each_second,  ///< at most one line a second, so none for work that ends within the first
};

/// May be told from several threads.
class ProgressLine {
 public:
  using Clock = std::chrono::steady_clock;

  /// `file_descriptor`: 1 or 2; a bar is drawn only where it is a terminal. `now`: another clock, for tests.
  ProgressLine(int file_descriptor, PlainLines plain, std::function<Clock::time_point()> now = Clock::now);
  ~ProgressLine();

  /// At most ten redraws of the bar a second.
  void tell(const std::string& stage, std::uint64_t done, std::uint64_t total);
  /// A line that stays, e.g. a change of state.
  void say(const std::string& line);
  /// Wipes the bar, if there is one.
  void clear();

 private:
  void draw(const std::string& stage, std::uint64_t done, std::uint64_t total);
  bool line_is_due(const std::string& stage, std::uint64_t tenth) const;
  void write(const std::string& text);

  const int file_descriptor_;
  const bool bar_;
  const PlainLines plain_;
  const std::function<Clock::time_point()> now_;
  std::mutex mutex_;
  Clock::time_point drawn_at_{};  ///< of the bar
  Clock::time_point line_at_;     ///< of the last plain line; at first, of the start
  std::string stage_;
  std::uint64_t tenth_ = 0;
  bool on_screen_ = false;
};

}  // namespace sculpt::cli
