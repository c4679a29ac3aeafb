// The languages of controllers that programs are written in, and what each can take.
#pragma once

#include <cstddef>
#include <string>

namespace sculpt {

enum class Dialect { krl, rapid, urscript, fanuc, gcode, ros2 };

struct DialectFacts {
  const char* name;
  const char* extension;          ///< of a part, with the dot
  std::size_t part_keyframes;     ///< of a part, unless it is said; 0: all of the plan
  bool needs_six = false;         ///< robot axes 1 to 6, all of them
  std::size_t external_axes = 0;  ///< E1..., besides
  bool has_main = false;          ///< a program that calls the parts and remembers the next one
  int decimals = 0;               ///< of degrees and millimetres, where these are few; 0: finer than plans are
};

const DialectFacts& facts_of(Dialect dialect);
/// Throws InputError `dialect_unknown`.
Dialect parse_dialect(const std::string& name);

}  // namespace sculpt
