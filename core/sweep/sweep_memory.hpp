// What a sweep knows besides its keyframes.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/sweep/directions.hpp"
#include "core/sweep/hub_arm.hpp"
#include "core/sweep/straight_pass.hpp"

namespace sculpt {

/// As of the end of a pass or, where `pass` is set, of a batch of layers. Together with the keyframes until then it is
/// all that what comes next depends on. What can be had from them is not in it: what stands and what holds it, where
/// the joints are, the fields of the directions, what is left to cut along tilted ones.
struct SweepMemory {
  std::vector<char> used_up;               ///< per direction: the last pass along it cut nothing
  std::vector<char> spared;                ///< in the last pass along it something was left lest a piece come free
  std::vector<std::size_t> tilted_fields;  ///< of which tilted directions the fields are known
  std::vector<Opening> openings;           ///< in order
  std::uint64_t asked_with = 0;            ///< how many voxels stood when that was last asked for
  bool tilted = false;                     ///< tilted directions are being tried
  bool cut_tilted = false;                 ///< and something was cut along one
  std::optional<std::vector<Voxel>> out_of_reach;  ///< what no direction can cut, once that was asked
  HubArmMemory arm;
  std::optional<std::size_t> direction;  ///< whose field the arm is in; none at home
  std::optional<StraightMark> pass;      ///< along that direction
};

}  // namespace sculpt
