// Which shapes of which links are kept apart, and which links may touch: found out, not listed by hand.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/cell/cell.hpp"

namespace sculpt {

/// Shapes of two links, by number, that must be kept apart; one of the first link and one of the second each.
struct CheckedLinks {
  LinkPair links;
  std::vector<std::pair<std::size_t, std::size_t>> shapes;
  double gap_m;  ///< they are this far apart at home, or farther
};

/// Links of which some shapes that move against each other may touch, and why.
struct UncheckedLinks {
  LinkPair links;
  std::string why;
};

/// Places along a joint's travel that are looked at: at how many of them do two links touch?
inline constexpr int travel_points = 65;

struct LinkPairs {
  std::vector<CheckedLinks> checked;      ///< in order of their links, a pair once
  std::vector<UncheckedLinks> unchecked;  ///< in order, a pair once a reason
};

/// Shapes of links that some joint of the chain moves against each other must be kept apart, but for
/// - pairs of links in `ignore_pairs` (those in `check_pairs` are kept apart whatever follows),
/// - a bearing: shapes of neighbours (links across one joint, with all that is rigidly fixed to either) that touch at
///   home, at the joint's axis or along at least half of its travel,
/// - shapes of other links that touch at home and, as far as can be found out, everywhere.
/// Shapes that are more than 0.02 mm apart at home are never left out. Deterministic.
LinkPairs find_link_pairs(const Cell& cell);

/// Group of each link: links joined by fixed joints share one (the index of their topmost link).
std::vector<int> rigid_groups(const Robot& robot);

}  // namespace sculpt
