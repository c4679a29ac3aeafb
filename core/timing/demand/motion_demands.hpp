// How fast a plan is to be gone through.
#pragma once

#include <optional>

namespace sculpt {

struct MotionDemands {
  double feed_m_s = 0;              ///< the ball's largest speed while it cuts
  double rapid_m_s = 0.5;           ///< and on moves
  std::optional<double> keep_feed;  ///< share of the feed that every cut must keep
  double reserve_m = 0;             ///< of all certified margins, kept free for what rounds joint values later
};

/// Throws InputError `feed_invalid` for a speed that is no positive number, or a share that is none.
void check_demands(const MotionDemands& demands);

}  // namespace sculpt
