// Two bodies of a scene that are near each other, for people: which they are, and how near.
#pragma once

namespace sculpt {

/// A body is what is rigidly fixed to one link (its index), the tool, that is ball and shank, or the stock.
struct NearBodies {
  static constexpr int stock = -1, tool = -2;

  int first, second;      ///< links, `tool` as either, `stock` as the second one only
  double gap_m;           ///< they are at least so far apart; 0: they may touch
  bool too_near = false;  ///< nearer than planning allows
};

}  // namespace sculpt
