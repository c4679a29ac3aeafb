#include "core/program/program_demands.hpp"

#include <algorithm>

#include "core/base/error.hpp"

namespace sculpt {

void check_program_name(const std::string& name) {
  const auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
  const bool good = !name.empty() && name.size() <= 19 && is_letter(name[0]) && std::ranges::all_of(name, [&](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || c == '_';
  });
  if (!good)
    throw InputError("name_invalid", "'" + name +
                                         "' is no name that every controller takes: give a file or folder of up to 19 "
                                         "lower-case letters, digits and _, beginning with a letter");
}

}  // namespace sculpt
