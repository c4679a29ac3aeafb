// Which robot program of a plan is wanted: for which controller, in what parts and how fast.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "proto/motion/motion_spec.hpp"

namespace sculpt::proto {

/// Meaning as in core/program/program_demands.hpp.
struct ProgramSpec {
  std::string dialect;
  std::string name = "sculpt";
  MotionSpec motion;
  std::optional<std::uint64_t> part_keyframes, part_bytes;
  bool stock_files = false, seams_in_stock = false;
};

/// Throws ProtocolError `params_invalid` with the pointer of the field to blame.
ProgramSpec read_program(Fields fields);
/// Fields at their default are left out: equal specs give equal text.
Json to_json(const ProgramSpec& spec);

}  // namespace sculpt::proto
