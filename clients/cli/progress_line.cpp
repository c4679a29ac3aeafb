#include "clients/cli/progress_line.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace sculpt {

namespace {

constexpr int bar_cells = 30;

std::string counts(std::uint64_t done, std::uint64_t total) {
  return total == 0 ? std::string() : std::to_string(done) + "/" + std::to_string(total);
}

std::string bar_text(const std::string& stage, std::uint64_t done, std::uint64_t total) {
  const double share = total == 0 ? 0 : static_cast<double>(std::min(done, total)) / static_cast<double>(total);
  const int full = static_cast<int>(share * bar_cells);
  char head[64];
  std::snprintf(head, sizeof head, "%-9.20s [", stage.c_str());
  char tail[64];
  std::snprintf(tail, sizeof tail, "] %3d%% ", static_cast<int>(share * 100));
  return head + std::string(full, '#') + std::string(bar_cells - full, '.') + tail + counts(done, total);
}

}  // namespace

ProgressLine::ProgressLine(int file_descriptor, bool plain)
    : file_descriptor_(file_descriptor), bar_(isatty(file_descriptor) == 1), plain_(plain) {}

ProgressLine::~ProgressLine() {
  clear();
}

void ProgressLine::tell(const std::string& stage, std::uint64_t done, std::uint64_t total) {
  const std::lock_guard lock(mutex_);
  const std::uint64_t tenth = total == 0 ? 0 : 10 * std::min(done, total) / total;
  const bool moved_on = stage != stage_ || tenth != tenth_;
  if (bar_) {
    const auto now = std::chrono::steady_clock::now();
    if (stage == stage_ && now - drawn_at_ < std::chrono::milliseconds(100)) return;
    drawn_at_ = now;
    write("\r\x1b[K" + bar_text(stage, done, total));
    on_screen_ = true;
  } else if (plain_ && moved_on) {
    const std::string numbers = counts(done, total);
    write(stage + (numbers.empty() ? "" : " " + numbers) + "\n");
  }
  stage_ = stage;
  tenth_ = tenth;
}

void ProgressLine::say(const std::string& line) {
  const std::lock_guard lock(mutex_);
  if (!bar_ && !plain_) return;
  write((on_screen_ ? "\r\x1b[K" : "") + line + "\n");
  on_screen_ = false;
}

void ProgressLine::clear() {
  const std::lock_guard lock(mutex_);
  if (on_screen_) write("\r\x1b[K");
  on_screen_ = false;
}

void ProgressLine::write(const std::string& text) {
  std::size_t at = 0;
  while (at < text.size()) {
    const ssize_t n = ::write(file_descriptor_, text.data() + at, text.size() - at);
    if (n <= 0) return;
    at += static_cast<std::size_t>(n);
  }
}

}  // namespace sculpt
