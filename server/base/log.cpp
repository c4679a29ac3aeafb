#include "server/base/log.hpp"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "proto/json.hpp"
#include "server/base/time_stamp.hpp"

namespace sculpt::server {
namespace {

constexpr std::array<std::string_view, 3> field_names{"job", "conn", "attempt"};

struct LogField {
  std::string_view name, value;
};

struct CodePoint {
  std::size_t bytes = 0;  // of UTF-8; 0: the text does not begin with any
  char32_t value = 0;
};

CodePoint first_code_point(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80) return {1, byte(0)};
  const std::size_t bytes = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
  if (byte(0) < 0xc2 || byte(0) > 0xf4 || text.size() < bytes) return {};
  char32_t value = byte(0) & (0x7fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    value = value << 6 | (byte(i) & 0x3fu);
  }
  constexpr std::array<char32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = value >= 0xd800 && value < 0xe000;
  return value < least[bytes] || surrogate || value > 0x10ffff ? CodePoint{} : CodePoint{bytes, value};
}

// What moves the cursor, ends a line or turns the direction of writing: for some reader of the log it may.
bool is_tricky(char32_t point) {
  return point < 0x20 || (point >= 0x7f && point < 0xa0) || point == 0xad || point == 0x61c ||
         (point >= 0x200b && point <= 0x200f) || (point >= 0x2028 && point <= 0x202e) ||
         (point >= 0x2060 && point <= 0x206f) || point == 0xfeff;
}

// With \x0a for control characters and bytes that are no UTF-8, \u202e for other tricky ones. JSON text, which holds
// none of the former, stays JSON.
std::string printable(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const CodePoint point = first_code_point(text);
    const auto byte = static_cast<unsigned char>(text.front());
    if (point.bytes == 0 || byte < 0x20) {
      out += fmt::format("\\x{:02x}", byte);
    } else if (is_tricky(point.value)) {
      out += fmt::format("\\u{:04x}", static_cast<std::uint32_t>(point.value));
    } else {
      out += text.substr(0, point.bytes);
    }
    text.remove_prefix(std::max<std::size_t>(point.bytes, 1));
  }
  return out;
}

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
  return printable(proto::write_json(line));
}

std::string text_line(const std::string& time, std::string_view level, std::string_view message) {
  return time + " " + std::string(level) + " " + printable(message);
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

}  // namespace sculpt::server
