// Bodies of a cell -> which pairs must be kept apart: a rule of the replay's own. Internal to verify/.
#pragma once

#include <utility>
#include <vector>

#include "core/cell/cell.hpp"
#include "core/verify/robot/exempt_pair.hpp"
#include "core/verify/robot/link_motion.hpp"
#include "core/verify/robot/solid_body.hpp"

namespace sculpt {

struct CheckedPairs {
  std::vector<std::pair<const SolidBody*, const SolidBody*>> checked;
  std::vector<ExemptPair> exempt;  ///< sorted, none twice
  std::vector<LinkPair> contacts;  ///< links with bodies that are checked though they touch at home; sorted, none twice
};

/// Every two bodies that move against each other are checked, unless
/// - they touch at home, one joint moves between them, and they are of its bearing: they meet on its axis, or touch
///   inside a body that does, or, for a slide, touch along half of its travel;
/// - it is proved that they overlap in every configuration within the limits;
/// - the cell's `ignore_pairs` names their links.
/// The cell's `check_pairs` overrules all of this. `joints`: robot joint of each coordinate. The bodies must outlive
/// the pairs.
CheckedPairs choose_pairs(const Cell& cell, const std::vector<int>& joints, const LinkMotion& motion,
                          const std::vector<SolidBody>& bodies);

}  // namespace sculpt
