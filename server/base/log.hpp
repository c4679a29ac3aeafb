// The log: standard error, one line an event, as text for people or JSON for programs.
//
// A message may begin with words like job=01J... conn=7 attempt=2; those three become fields of the JSON form. Whatever
// comes from outside stands behind other words, so it cannot pass for a field, and control characters are escaped, so
// it cannot pass for a line. Messages never hold requests, tokens or keys.
#pragma once

#include <spdlog/formatter.h>

#include <memory>

#include "server/base/config.hpp"

namespace sculpt::server {

enum class LogForm { text, json };

/// 2026-01-31T12:00:00.000Z info job=... message, or {"time":...,"level":...,"job":...,"message":...}
class LogFormatter : public spdlog::formatter {
 public:
  explicit LogFormatter(LogForm form) : form_(form) {}
  void format(const spdlog::details::log_msg& event, spdlog::memory_buf_t& line) override;
  std::unique_ptr<formatter> clone() const override { return std::make_unique<LogFormatter>(form_); }

 private:
  LogForm form_;
};

/// Makes spdlog's default logger. Once, before the first message.
void start_log(const Config& config);
/// Takes level and form from the config; any time, from any thread.
void set_log(const Config& config);

}  // namespace sculpt::server
