// A time law as a file: 16 bytes a keyframe. docs/timing.md describes the bytes.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string_view>

#include "core/law/time_law.hpp"

namespace sculpt {

/// Which keyframes a law is for: of their joint values, one after the other. Start with {}.
struct PlanMark {
  std::uint64_t keyframes = 0;
  std::uint32_t crc = 0;  ///< zlib's CRC-32 of the values as little-endian doubles

  void add(const Configuration& q);
  bool operator==(const PlanMark&) const = default;
};

/// `half` and `cruise` must be numbers of core/law/coarse.
void write_law(std::ostream& out, const TimeLaw& law, const PlanMark& plan);

struct LawFile {
  TimeLaw law;
  PlanMark plan;
};

/// Throws InputError `law_invalid` for bytes that write_law did not write.
LawFile read_law(std::istream& in);

}  // namespace sculpt
