// Where a tool waits between its ways, in a direction: high above the stock.
#pragma once

#include <functional>
#include <optional>

#include "core/mill/drive/reach_floor.hpp"
#include "core/mill/map/site.hpp"
#include "core/sweep/field/posture_field.hpp"

namespace sculpt {

/// A place of the tip (tool frame) above everything, from where the robot comes down, as near to the middle as there is
/// one; else one from where it does not, or one that is above what stands about it: along a tilted axis the tip may
/// have no room above everything. `around`: the grid that the field is laid over; `room_m`: above everything, at most.
/// `goes_down`: does the arm follow straight down?
std::optional<Vec3> find_hub(const Site& site, const ReachFloor& reach, const PostureField& field, const Grid& around,
                             double room_m, const std::function<bool(const Vec3& hub, const Vec3& low)>& goes_down);

}  // namespace sculpt
