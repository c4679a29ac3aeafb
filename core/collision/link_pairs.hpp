// Which links can hit which: found by trying, not listed by hand.
#pragma once

#include <utility>
#include <vector>

#include "core/cell/robot.hpp"

namespace sculpt {

/// The pairs of link indices (first < second) whose shapes must be kept apart. Left out are links without shapes, links
/// that are rigidly joined, neighbours across one joint, and pairs that touch in every one of many sampled
/// configurations (they touch by design). Deterministic.
std::vector<std::pair<int, int>> find_link_pairs(const Robot& robot);

/// Group of each link: links joined by fixed joints share one (the index of their topmost link).
std::vector<int> rigid_groups(const Robot& robot);

}  // namespace sculpt
