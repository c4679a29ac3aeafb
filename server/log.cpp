#include "server/log.hpp"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "proto/json.hpp"
#include "server/time_stamp.hpp"

namespace sculpt {
namespace {

constexpr std::array<std::string_view, 3> field_names{"job", "conn", "attempt"};

struct LogField {
  std::string_view name, value;
};

// Takes "name=value " off the front of the message if the name is a field's.
std::optional<LogField> take_field(std::string_view& message) {
  const std::string_view word = message.substr(0, message.find(' '));
  const std::size_t equals = word.find('=');
  if (equals == std::string_view::npos) return std::nullopt;
  const LogField field{word.substr(0, equals), word.substr(equals + 1)};
  if (std::ranges::find(field_names, field.name) == field_names.end()) return std::nullopt;
  message.remove_prefix(std::min(message.size(), word.size() + 1));
  return field;
}

Json field_value(std::string_view text) {
  const bool number =
      !text.empty() && text.size() < 19 && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
  return number ? Json(std::stoull(std::string(text))) : Json(text);
}

std::string json_line(const std::string& time, std::string_view level, std::string_view message) {
  Json line{{"time", time}, {"level", level}};
  while (const std::optional<LogField> field = take_field(message))
    line[std::string(field->name)] = field_value(field->value);
  line["message"] = message;
  return write_json(line);
}

std::string text_line(const std::string& time, std::string_view level, std::string_view message) {
  std::string line = time + " " + std::string(level) + " ";
  for (const char c : message) {
    const auto byte = static_cast<unsigned char>(c);
    line += byte < 0x20 || byte == 0x7f ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
  }
  return line;
}

std::string_view view(const spdlog::string_view_t& text) {
  return {text.data(), text.size()};
}

}  // namespace

void LogFormatter::format(const spdlog::details::log_msg& event, spdlog::memory_buf_t& line) {
  const auto since = std::chrono::duration_cast<std::chrono::milliseconds>(event.time.time_since_epoch());
  const std::string time = utc_text(static_cast<std::uint64_t>(since.count()));
  const std::string_view level = view(spdlog::level::to_string_view(event.level)), message = view(event.payload);
  const std::string text = form_ == LogForm::json ? json_line(time, level, message) : text_line(time, level, message);
  line.append(text.data(), text.data() + text.size());
  line.push_back('\n');
}

void start_log(const Config& config) {
  spdlog::set_default_logger(spdlog::stderr_logger_mt("sculptd"));
  set_log(config);
}

void set_log(const Config& config) {
  spdlog::set_formatter(std::make_unique<LogFormatter>(config.log_format == "json" ? LogForm::json : LogForm::text));
  spdlog::set_level(spdlog::level::from_str(config.log));
}

}  // namespace sculpt
