// Cell -> links that a replay would find in contact at home, asked before anything is planned.
#pragma once

#include <string>
#include <vector>

#include "core/cell/cell.hpp"

namespace sculpt {

/// Links with bodies that touch at home though no joint holds them together there, nothing proves that they overlap
/// everywhere, and the cell's `ignore_pairs` do not name them: a replay finds them at each keyframe. Sorted, none
/// twice. `joints`: robot joint of each coordinate of the chain, as in a trajectory's header. Tool and material are not
/// looked at. Safe from any thread.
std::vector<LinkPair> find_home_contacts(const Cell& cell, const std::vector<int>& joints);

/// "link a and link b touch at home, ..." with the cure.
std::string describe_home_contact(const Robot& robot, const LinkPair& links);

}  // namespace sculpt
