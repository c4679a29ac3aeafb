// What is asked of a program, and what came of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/program/dialect.hpp"
#include "core/timing/demand/motion_demands.hpp"

namespace sculpt {

struct ProgramDemands {
  Dialect dialect = Dialect::krl;
  std::string name;                           ///< of the program: letters, digits and _, beginning with a letter
  std::optional<std::size_t> part_keyframes;  ///< without it what the dialect takes
  std::optional<std::uint64_t> part_bytes;    ///< of a part's texts; with both no part has more of either
  bool stock_files = false;                   ///< with each part comes a .binvox of what stands when it begins
  bool seams_in_stock = false;                ///< parts may begin and end with the tool in the material
  MotionDemands motion;
};

/// Throws InputError `name_invalid`.
void check_program_name(const std::string& name);

struct ProgramReport {
  std::size_t parts = 0, files = 0;
  std::uint64_t moves = 0, bytes = 0;
  double seconds = 0;               ///< of all moves, by the numbers that are written
  double rounding_m = 0;            ///< that ball or shank's end are off at most, because of the digits of the dialect
  std::uint64_t retreat_moves = 0;  ///< that leave the material at the end of parts, or come back
};

}  // namespace sculpt
