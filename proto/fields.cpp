#include "proto/fields.hpp"

#include <chrono>
#include <cmath>
#include <regex>

namespace sculpt::proto {
namespace {

std::string escaped(const std::string& field) {
  std::string out;
  for (const char c : field) {
    if (c == '~') {
      out += "~0";
    } else if (c == '/') {
      out += "~1";
    } else {
      out += c;
    }
  }
  return out;
}

std::string shown(double value) {
  return write_json(Json(value));
}

}  // namespace

Fields::Fields(const Json& object, std::string pointer) : object_(&object), pointer_(std::move(pointer)) {
  if (!object.is_object()) {
    throw ProtocolError("params_invalid", pointer_ + " must be an object, not " + object.type_name(), pointer_);
  }
}

bool Fields::has(const std::string& field) {
  known_.insert(field);
  return object_->contains(field);
}

const Json& Fields::take(const std::string& field) {
  known_.insert(field);
  const auto found = object_->find(field);
  if (found == object_->end()) refuse(field, "is missing");
  return *found;
}

const Json& Fields::value(const std::string& field) {
  return take(field);
}

std::string Fields::text(const std::string& field, std::size_t max_bytes) {
  const Json& value = take(field);
  if (!value.is_string()) refuse(field, std::string("must be a string, not ") + value.type_name());
  const auto& text = value.get_ref<const std::string&>();
  if (text.empty()) refuse(field, "must not be empty");
  if (text.size() > max_bytes) refuse(field, "must have at most " + std::to_string(max_bytes) + " bytes");
  return text;
}

std::string Fields::sha256(const std::string& field) {
  const std::string hash = text(field, 64);
  if (hash.size() != 64 || hash.find_first_not_of("0123456789abcdef") != std::string::npos) {
    refuse(field, "must be a SHA-256 of 64 lower-case hex digits");
  }
  return hash;
}

std::int64_t Fields::integer(const std::string& field, std::int64_t low, std::int64_t high) {
  const Json& value = take(field);
  const std::string range = "must be an integer from " + std::to_string(low) + " to " + std::to_string(high);
  if (!value.is_number_integer())
    refuse(field, range + (value.is_number() ? "" : std::string(", not ") + value.type_name()));
  const bool huge = value.is_number_unsigned() && value.get<std::uint64_t>() > INT64_MAX;
  if (huge || value.get<std::int64_t>() < low || value.get<std::int64_t>() > high) {
    refuse(field, range + ", not " + write_json(value));
  }
  return value.get<std::int64_t>();
}

std::uint64_t Fields::count(const std::string& field, std::uint64_t high) {
  const Json& value = take(field);
  const bool natural = value.is_number_unsigned() || (value.is_number_integer() && value.get<std::int64_t>() >= 0);
  if (!natural || value.get<std::uint64_t>() > high) {
    refuse(field, "must be an integer from 0 to " + std::to_string(high));
  }
  return value.get<std::uint64_t>();
}

bool Fields::flag(const std::string& field) {
  const Json& value = take(field);
  if (!value.is_boolean()) refuse(field, "must be true or false");
  return value.get<bool>();
}

double Fields::number(const std::string& field, double low, double high) {
  const Json& value = take(field);
  if (!value.is_number()) refuse(field, std::string("must be a number, not ") + value.type_name());
  const double number = value.get<double>();
  if (!(number >= low && number <= high)) refuse(field, "must be from " + shown(low) + " to " + shown(high));
  return number;
}

std::array<double, 3> Fields::triple(const std::string& field) {
  const Json& value = take(field);
  if (!value.is_array() || value.size() != 3) refuse(field, "must be an array of 3 numbers");
  std::array<double, 3> out{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!value[i].is_number() || !std::isfinite(value[i].get<double>())) refuse(field, "must be an array of 3 numbers");
    out[i] = value[i].get<double>();
  }
  return out;
}

std::string Fields::utc_time(const std::string& field) {
  static const std::regex form(R"((\d{4})-(\d\d)-(\d\d)T([01]\d|2[0-3]):[0-5]\d:[0-5]\d(\.\d{1,3})?Z)");
  const std::string given = text(field, 30);
  std::smatch parts;
  const bool well_formed = std::regex_match(given, parts, form);
  const auto number = [&](std::size_t part) { return static_cast<unsigned>(std::stoul(parts[part])); };
  if (!well_formed || !std::chrono::year_month_day(std::chrono::year(static_cast<int>(number(1))),
                                                   std::chrono::month(number(2)), std::chrono::day(number(3)))
                           .ok()) {
    refuse(field, "must be a moment in UTC such as 2026-01-31T12:00:00Z, not '" + given + "'");
  }
  std::string fraction = parts[5].str().empty() ? "." : parts[5].str();
  fraction.resize(4, '0');
  return given.substr(0, 19) + fraction + "Z";
}

Fields Fields::object(const std::string& field) {
  return Fields(take(field), pointer_to(field));
}

void Fields::done() const {
  for (const auto& [field, value] : object_->items()) {
    if (known_.contains(field)) continue;
    std::string names;
    for (const std::string& name : known_) names += (names.empty() ? "" : ", ") + name;
    refuse(field,
           names.empty() ? "is not known: no fields are expected here" : "is not known; the fields here are: " + names);
  }
}

std::string Fields::pointer_to(const std::string& field) const {
  return pointer_ + "/" + escaped(field);
}

void Fields::refuse(const std::string& field, const std::string& sentence) const {
  throw ProtocolError("params_invalid", pointer_to(field) + " " + sentence, pointer_to(field));
}

}  // namespace sculpt::proto
