// A JSON value of a cell file, read with its place named. Internal to core/cell: no other file sees JSON there.
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/frame.hpp"

namespace sculpt {

/// Of a holder, or of the body of a tool.
inline constexpr std::size_t max_sections = 16;

inline InputError cell_error(const std::string& where, const std::string& sentence) {
  return {"cell_invalid", "cell file, " + (where.empty() ? std::string("top level") : where) + ": " + sentence};
}

[[noreturn]] inline void refuse(const std::string& where, const std::string& sentence) {
  throw cell_error(where, sentence);
}

/// The value of a whole file, which `what` names. Throws InputError `code` for what is no JSON, with line and column,
/// or nests values deeper than a cell file or a tool library does.
inline nlohmann::json parse_document(const std::string& text, const std::string& code, const std::string& what) {
  constexpr int deepest = 16;
  const auto limit_depth = [&](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
    if (depth > deepest) throw InputError(code, what + " nests values more than 16 deep: it is something else");
    return true;
  };
  try {
    return nlohmann::json::parse(text, limit_depth);
  } catch (const nlohmann::json::exception& error) {
    throw InputError(code, what + " is not valid JSON: " + error.what());
  }
}

/// One JSON value of the cell file and its JSON pointer; every read checks the type and names the place.
class CellField {
 public:
  CellField(const nlohmann::json& value, std::string pointer) : value_(value), pointer_(std::move(pointer)) {}

  /// Refuses anything but an object, and any field that is not in `known`.
  void require_object(const std::vector<std::string>& known) const {
    require(value_.is_object(), "an object");
    std::string list;
    for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
    for (const auto& [name, value] : value_.items()) {
      if (std::find(known.begin(), known.end(), name) == known.end()) {
        refuse(pointer_ + "/" + name, "unknown field; known here: " + list);
      }
    }
  }
  bool has(const std::string& name) const { return value_.contains(name); }
  CellField at(const std::string& name) const {
    if (!has(name)) refuse(pointer_ + "/" + name, "missing field");
    return CellField(value_.at(name), pointer_ + "/" + name);
  }
  std::string text() const {
    require(value_.is_string() && !value_.get_ref<const std::string&>().empty(), "a text that is not empty");
    return value_.get<std::string>();
  }
  double number() const {
    require(value_.is_number(), "a number");
    return value_.get<double>();
  }
  double number_from(double least) const {
    const double number_here = number();
    if (number_here < least) {
      std::ostringstream limit;
      limit << "must be at least " << least;
      refuse(pointer_, limit.str());
    }
    return number_here;
  }
  /// A length in a room, m: a larger one was meant in millimetres.
  double length_from(double min_m) const {
    constexpr double max_m = 1000;
    const double length_m = number_from(min_m);
    if (length_m > max_m) {
      std::ostringstream limit;
      limit << length_m << " m is in no room: give metres, at most " << max_m;
      refuse(pointer_, limit.str());
    }
    return length_m;
  }
  /// A place in a room, m.
  Vec3 position() const {
    require(value_.is_array() && value_.size() == 3, "an array of three numbers");
    Vec3 out;
    for (std::size_t i = 0; i < 3; ++i)
      out[static_cast<int>(i)] = CellField(value_[i], pointer_ + "/" + std::to_string(i)).length_from(-1000);
    return out;
  }
  std::vector<CellField> elements() const {
    require(value_.is_array(), "an array");
    std::vector<CellField> out;
    for (std::size_t i = 0; i < value_.size(); ++i) out.emplace_back(value_[i], pointer_ + "/" + std::to_string(i));
    return out;
  }
  std::vector<std::pair<std::string, CellField>> members() const {
    require(value_.is_object(), "an object");
    std::vector<std::pair<std::string, CellField>> out;
    for (const auto& [name, value] : value_.items()) out.emplace_back(name, CellField(value, pointer_ + "/" + name));
    return out;
  }
  const std::string& pointer() const { return pointer_; }

 private:
  void require(bool good, const std::string& what) const {
    if (!good) refuse(pointer_, "must be " + what + ", not " + value_.type_name());
  }

  const nlohmann::json& value_;
  std::string pointer_;
};

}  // namespace sculpt
