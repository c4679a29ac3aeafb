// The fields of a trajectory line, read with their types checked. Internal to trajectory/.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/error.hpp"
#include "core/base/frame.hpp"
#include "core/trajectory/text/number_text.hpp"

namespace sculpt {

/// Throws InputError `trajectory_invalid`.
[[noreturn]] inline void refuse_line(const std::string& where, const std::string& what) {
  throw InputError("trajectory_invalid", where + ": " + what + "; fetch or plan the trajectory again");
}

/// As a list: `[1,2]`.
template <typename Values>
void append_numbers(std::string& text, const Values& values) {
  text += '[';
  bool first = true;
  for (const double value : values) {
    if (!first) text += ',';
    append_number(text, value);
    first = false;
  }
  text += ']';
}

/// Typed access to the fields of one object; every refusal names the field. Both arguments must outlive it.
class LineFields {
 public:
  using Json = nlohmann::json;

  LineFields(const Json& object, const std::string& where) : object_(object), where_(where) {}

  const Json& get(const char* key) const {
    const auto found = object_.find(key);
    if (found == object_.end()) refuse_line(where_, std::string("field \"") + key + "\" is missing");
    return *found;
  }
  LineFields object(const char* key) const {
    const Json& value = get(key);
    if (!value.is_object()) refuse_line(where_, std::string("field \"") + key + "\" is not an object");
    return {value, where_};
  }
  bool has(const char* key) const { return object_.contains(key); }
  const std::string& where() const { return where_; }
  std::string text(const char* key) const {
    const Json& value = get(key);
    if (!value.is_string()) refuse_line(where_, std::string("field \"") + key + "\" is not a string");
    return value.get<std::string>();
  }
  double number(const char* key, double least) const { return checked(get(key), key, least); }
  std::uint64_t count(const char* key) const {
    const Json& value = get(key);
    if (!value.is_number_unsigned())
      refuse_line(where_, std::string("field \"") + key + "\" is not a whole number from 0 up");
    return value.get<std::uint64_t>();
  }
  /// False where it is missing.
  bool flag(const char* key) const {
    const auto found = object_.find(key);
    if (found == object_.end()) return false;
    if (!found->is_boolean()) refuse_line(where_, std::string("field \"") + key + "\" is neither true nor false");
    return found->get<bool>();
  }
  const Json& array(const char* key, std::size_t least, std::size_t most) const {
    const Json& value = get(key);
    if (!value.is_array() || value.size() < least || value.size() > most)
      refuse_line(where_, std::string("field \"") + key + "\" is not a list of " + std::to_string(least) +
                              (least == most ? "" : " to " + std::to_string(most)) + " values");
    return value;
  }
  Configuration numbers(const char* key, std::size_t size) const {
    const Json& values = array(key, size, size);
    Configuration q(static_cast<Eigen::Index>(size));
    for (std::size_t at = 0; at < size; ++at)
      q[static_cast<Eigen::Index>(at)] = checked(values[at], key, -std::numeric_limits<double>::max());
    return q;
  }

 private:
  double checked(const Json& value, const char* key, double least) const {
    if (!value.is_number())
      refuse_line(where_, std::string("field \"") + key + "\" holds something that is not a number");
    const double number = value.get<double>();
    if (!std::isfinite(number) || number < least)
      refuse_line(where_, std::string("field \"") + key + "\" is out of range");
    return number;
  }

  const Json& object_;
  const std::string& where_;
};

}  // namespace sculpt
