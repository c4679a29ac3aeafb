// What the parts of all dialects have, read from a line. Internal to read/.
#pragma once

#include <cmath>

#include "core/program/read/program_line.hpp"
#include "core/program/read/read_part.hpp"

namespace sculpt {

/// Of "MOUNT TOOL 2 D12", which stands before the first move.
inline int mounted(ProgramLine& line, const ReadPart& part) {
  line.need("MOUNT TOOL ");
  const double number = line.number();
  if (!(number >= 1) || number != std::floor(number)) line.refuse("a tool has no number");
  if (part.tool != 0 || !part.start.empty() || !part.moves.empty()) line.refuse("a tool is mounted after the start");
  return static_cast<int>(number);
}

/// Of "VOXELS CUT BEFORE 17", behind "VOXELS CUT ".
inline void take_voxels(ProgramLine& line, ReadPart& part) {
  std::uint64_t& count = line.take("BEFORE ") ? part.cut_before : (line.need("AFTER "), part.cut_after);
  const double number = line.number();
  if (!(number >= 0) || number != std::floor(number) || !part.moves.empty()) line.refuse("a count of voxels is none");
  count = static_cast<std::uint64_t>(number);
}

/// Of an axis, where the part begins.
inline void take_start(ProgramLine& line, ReadPart& part, double value) {
  if (!part.moves.empty()) line.refuse("the start is checked when the robot has moved");
  part.start.push_back(value);
}

/// The statement behind it, that the controller waits at, must be in the very next line.
inline void need_stop(ProgramLine& line, bool& awaited, std::string_view word) {
  if (!awaited) return;
  awaited = false;
  line.blanks();
  if (!line.rest().starts_with(word)) line.refuse("it goes on where it must stop");
}

inline double as_float(double value) {
  return static_cast<double>(static_cast<float>(value));
}

}  // namespace sculpt
