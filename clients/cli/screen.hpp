// The terminal as a page that is drawn again and again.
#pragma once

#include <termios.h>

#include <chrono>
#include <string>

namespace sculpt::cli {

/// While it lives, standard output shows a page of its own and keys come one by one; then all is as before.
class Screen {
 public:
  struct Size {
    int rows = 24, columns = 80;
  };

  /// Whether there is a terminal to draw on and to read keys from.
  static bool is_there();
  Screen();
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  /// As it is now: people resize terminals.
  Size size() const;
  /// Lines no longer than the size says, each ended by a line feed.
  void draw(const std::string& lines);
  /// Waits for so long at most. True when q or Ctrl-C was pressed or the terminal is gone.
  bool quit_pressed(std::chrono::milliseconds patience);

 private:
  termios before_{};
};

}  // namespace sculpt::cli
