// Neighbours that would leave the joint between them little room.
#pragma once

#include <vector>

#include "core/collision/link_pairs.hpp"

namespace sculpt {

struct WideContact {
  LinkPair links;
  int joint;
  double share;  ///< of the joint's travel
};

/// Of `checked`, the links on either side of one joint that touch along at least half of its travel: shapes that are
/// thicker than the arm, or an arm that is in its own way. Nobody can tell by the URDF. `checked`: of the cell.
std::vector<WideContact> find_wide_contacts(const Cell& cell, const std::vector<CheckedLinks>& checked);

/// "touch along 73 % of the travel of joint 'elbow'".
std::string describe(const WideContact& contact, const Robot& robot);

}  // namespace sculpt
