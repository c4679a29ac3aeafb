// The fields of one JSON object, taken one by one with their type and range; whatever was not taken is refused.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "proto/error_codes.hpp"

namespace sculpt::proto {

/// Of a cell, a robot or a tool library, as given by clients.
inline constexpr std::size_t max_name_bytes = 200;

/// Every method throws ProtocolError `params_invalid` with the field's pointer when it is missing or not what was asked
/// for. Refers to the object, which must outlive it.
class Fields {
 public:
  /// `pointer`: where the object stands in the request line, "/params" for the params.
  Fields(const Json& object, std::string pointer);

  /// Whether an optional field is there; from then on it is a known field.
  bool has(const std::string& field);
  std::string text(const std::string& field, std::size_t max_bytes = 1024);
  /// 64 lower-case hex digits.
  std::string sha256(const std::string& field);
  std::int64_t integer(const std::string& field, std::int64_t low, std::int64_t high);
  std::uint64_t count(const std::string& field, std::uint64_t high = UINT64_MAX);
  bool flag(const std::string& field);
  double number(const std::string& field, double low, double high);
  std::array<double, 3> triple(const std::string& field);
  /// A moment, "2026-01-31T12:00:00Z" or with up to three digits of seconds' fractions; given back with all three.
  std::string utc_time(const std::string& field);
  Fields object(const std::string& field);
  /// The field as it is.
  const Json& value(const std::string& field);

  /// Call last: throws for the first field that was never asked for, and names those that were.
  void done() const;

  std::string pointer_to(const std::string& field) const;
  [[noreturn]] void refuse(const std::string& field, const std::string& sentence) const;

 private:
  const Json& take(const std::string& field);

  const Json* object_;
  std::string pointer_;
  std::set<std::string> known_;
};

}  // namespace sculpt::proto
