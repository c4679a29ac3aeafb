// What the stages of a planning run have in common.
#pragma once

#include <cstdint>

#include "core/base/helpers.hpp"
#include "core/base/watch.hpp"

namespace sculpt {

/// Copyable; what it refers to must outlive all that is handed it.
struct RunContext {
  std::uint64_t seed = 0;  ///< the only source of chance
  const Helpers& helpers;  ///< the plan is the same with any
  const Watch& watch;
};

}  // namespace sculpt
