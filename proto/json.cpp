#include "proto/json.hpp"

#include <utf8.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

namespace sculpt::proto {
namespace {

void check_depth(std::string_view text) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (in_string) {
      if (c == '\\') ++at;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > max_json_depth) {
        throw JsonError("the JSON is nested more than " + std::to_string(max_json_depth) + " levels deep");
      }
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
}

// The keys of the objects that are open; throws where nlohmann would silently let the last of two equal keys win.
class StrictKeys {
 public:
  bool operator()(int, Json::parse_event_t event, Json& value) {
    using Event = Json::parse_event_t;
    if (event == Event::object_start) open_.emplace_back();
    if (event == Event::object_end) open_.pop_back();
    if (event == Event::key) add(value.get_ref<const std::string&>());
    if (event == Event::value && value.is_string()) refuse_nul(value.get_ref<const std::string&>());
    return true;
  }

 private:
  void add(const std::string& key) {
    refuse_nul(key);
    if (!open_.back().insert(key).second) throw JsonError("the key \"" + key + "\" occurs twice in one object");
    if (open_.back().size() > max_json_fields) {
      throw JsonError("an object has more than " + std::to_string(max_json_fields) + " fields");
    }
  }
  static void refuse_nul(const std::string& text) {
    if (text.find('\0') != std::string::npos) throw JsonError("a string holds the character NUL (\\u0000)");
  }

  std::vector<std::set<std::string>> open_;
};

// nlohmann's messages begin with "[json.exception.parse_error.101] parse error at line 1, column 5: ".
std::string without_prefix(const std::string& message) {
  const std::size_t end = message.find("] ");
  return end == std::string::npos ? message : message.substr(end + 2);
}

}  // namespace

Json parse_json(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) throw JsonError("it begins with a byte order mark: leave that out");
  check_depth(text);
  try {
    // The callback is passed by reference: nlohmann copies it into a std::function.
    StrictKeys keys;
    return Json::parse(text, std::ref(keys));
  } catch (const Json::exception& error) {
    throw JsonError(without_prefix(error.what()));
  }
}

std::string write_json(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

bool is_text(std::string_view line) {
  const auto is_control = [](char c) {
    return (static_cast<std::uint8_t>(c) < 0x20 && c != '\t' && c != '\r') || c == 0x7f;
  };
  return std::ranges::none_of(line, is_control) && utf8::is_valid(line.begin(), line.end());
}

}  // namespace sculpt::proto
