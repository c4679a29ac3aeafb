// What a program says, read back from its text by code that shares nothing with what wrote it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/program/dialect.hpp"

namespace sculpt {

/// Values as the text has them: degrees and mm, rad and m in URScript; as the controller would hold them where it keeps
/// fewer digits.
struct ReadMove {
  std::vector<double> values;
  double seconds = 0;  ///< 0: the dialect says a speed
  double share = 0;    ///< of an axis's velocity; 0: it says a time
};

struct ReadPart {
  int tool = 0;  ///< number of the one that it has mounted before anything moves; 0: it does not stop for that
  std::vector<double> start;  ///< that the part checks before it moves
  std::vector<ReadMove> moves;
  bool radians = false;  ///< values are rad and m
};

/// `axes`: how many. `letters`: their names where the text names them. Throws InputError `program_damaged` with the
/// line for a text that is none.
ReadPart read_part(Dialect dialect, std::string_view text, const std::vector<std::string>& letters);

}  // namespace sculpt
