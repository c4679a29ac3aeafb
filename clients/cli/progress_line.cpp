#include "clients/cli/progress_line.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace sculpt::cli {

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

ProgressLine::ProgressLine(int file_descriptor, PlainLines plain, std::function<Clock::time_point()> now)
    : file_descriptor_(file_descriptor),
      bar_(isatty(file_descriptor) == 1),
      plain_(plain),
      now_(std::move(now)),
      line_at_(now_()) {}

ProgressLine::~ProgressLine() {
  clear();
}

void ProgressLine::tell(const std::string& stage, std::uint64_t done, std::uint64_t total) {
  const std::lock_guard lock(mutex_);
  const std::uint64_t tenth = total == 0 ? 0 : 10 * std::min(done, total) / total;
  if (bar_) {
    draw(stage, done, total);
  } else if (line_is_due(stage, tenth)) {
    const std::string numbers = counts(done, total);
    write(stage + (numbers.empty() ? "" : " " + numbers) + "\n");
    line_at_ = now_();
  }
  stage_ = stage;
  tenth_ = tenth;
}

void ProgressLine::draw(const std::string& stage, std::uint64_t done, std::uint64_t total) {
  const Clock::time_point now = now_();
  if (stage == stage_ && now - drawn_at_ < std::chrono::milliseconds(100)) return;
  drawn_at_ = now;
  write("\r\x1b[K" + bar_text(stage, done, total));
  on_screen_ = true;
}

bool ProgressLine::line_is_due(const std::string& stage, std::uint64_t tenth) const {
  switch (plain_) {
    case PlainLines::none:
      return false;
    case PlainLines::on_change:
      return stage != stage_ || tenth != tenth_;
    case PlainLines::each_second:
      return now_() - line_at_ >= std::chrono::seconds(1);
  }
  return false;
}

void ProgressLine::say(const std::string& line) {
  const std::lock_guard lock(mutex_);
  if (!bar_ && plain_ == PlainLines::none) return;
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

}  // namespace sculpt::cli
