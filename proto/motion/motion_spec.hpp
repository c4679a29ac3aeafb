// How fast a plan is to be gone through.
#pragma once

#include <optional>

#include "proto/fields.hpp"

namespace sculpt::proto {

/// Meaning as in core/timing/demand/motion_order.hpp.
struct MotionSpec {
  std::optional<double> feed_m_s;
  double rapid_m_s = 0.5;
  std::optional<double> keep_feed;
};

/// Throws ProtocolError `params_invalid` with the pointer of the field to blame.
MotionSpec read_motion(Fields fields);
/// Fields at their default are left out: equal specs give equal text.
Json to_json(const MotionSpec& spec);

}  // namespace sculpt::proto
