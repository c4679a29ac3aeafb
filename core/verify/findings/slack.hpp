// What the replay allows for rounding, and its units.
#pragma once

namespace sculpt {

/// Shapes are looked at in millimetres.
inline constexpr double mm = 1000;
/// Of a joint against its limits (rad or m).
inline constexpr double joint_slack = 1e-9;
/// Joint values are stored in steps of 1e-7 rad or m, rounded to the inside of the limits: home may be that far aside.
inline constexpr double home_slack = 1e-7 + joint_slack;
/// Added to every geometry whose absence of contact is taken as proof, over libccd's own error.
inline constexpr double contact_slack_mm = 0.001;
/// The chips of milling tools may be thicker by this factor: no cut is followed exactly.
inline constexpr double chip_slack = 1.1;

}  // namespace sculpt
