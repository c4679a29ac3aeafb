// JSON that may come from strangers: read strictly, written so that it never throws.
#pragma once

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sculpt {

/// The value that all who speak the wire share. Fields keep the order in which they were written.
using Json = nlohmann::ordered_json;

}  // namespace sculpt

namespace sculpt::proto {

inline constexpr int max_json_depth = 64;
inline constexpr std::size_t max_json_fields = 1000;  ///< of one object: ordered_json looks fields up one by one

/// The text is not acceptable JSON; what() is a sentence.
class JsonError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws JsonError for anything but one value: syntax, deeper than max_json_depth, duplicate keys, numbers out of
/// range, NUL in a string. The depth is checked before parsing, because nlohmann's own recursion overflows the stack
/// when it writes such a value again.
Json parse_json(std::string_view text);

/// One line; bytes that are not UTF-8 become U+FFFD.
std::string write_json(const Json& value);

/// UTF-8 without control characters other than tab and carriage return.
bool is_text(std::string_view line);

}  // namespace sculpt::proto
