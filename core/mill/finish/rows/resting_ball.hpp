// Where a ball cutter rests.
#pragma once

#include <cstdint>

#include "core/base/frame.hpp"

namespace sculpt {

struct RestingBall {
  std::uint32_t nail = 0;  ///< that it rests on
  Vec3 middle;             ///< tool frame, m
  bool is_beside = false;  ///< in a crease, beside the nail: at another place it would leave more
};

}  // namespace sculpt
