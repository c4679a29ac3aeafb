#include "clients/cli/screen.hpp"

#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <iostream>

namespace sculpt::cli {

namespace {

constexpr char ctrl_c = 3;
constexpr const char* open_page = "\x1b[?1049h\x1b[?25l";
constexpr const char* close_page = "\x1b[?25h\x1b[?1049l";

}  // namespace

bool Screen::is_there() {
  return isatty(STDIN_FILENO) == 1 && isatty(STDOUT_FILENO) == 1;
}

Screen::Screen() {
  tcgetattr(STDIN_FILENO, &before_);
  termios keys = before_;
  keys.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO | ISIG);
  tcsetattr(STDIN_FILENO, TCSANOW, &keys);
  std::cout << open_page << std::flush;
}

Screen::~Screen() {
  std::cout << close_page << std::flush;
  tcsetattr(STDIN_FILENO, TCSANOW, &before_);
}

Screen::Size Screen::size() const {
  winsize window{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) != 0 || window.ws_row == 0 || window.ws_col == 0) return {};
  return {window.ws_row, window.ws_col};
}

void Screen::draw(const std::string& lines) {
  std::string page = "\x1b[H";
  for (const char c : lines) page += c == '\n' ? "\x1b[K\r\n" : std::string(1, c);
  std::cout << page << "\x1b[J" << std::flush;
}

bool Screen::quit_pressed(std::chrono::milliseconds patience) {
  pollfd keys{STDIN_FILENO, POLLIN, 0};
  if (poll(&keys, 1, static_cast<int>(patience.count())) <= 0) return false;
  char key = 0;
  return read(STDIN_FILENO, &key, 1) != 1 || key == 'q' || key == ctrl_c;
}

}  // namespace sculpt::cli
