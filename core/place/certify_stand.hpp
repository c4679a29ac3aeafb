// A stand of a cell -> the share of a target that is certified there: by the fields that sweeps plan with, no samples.
#pragma once

#include <cstdint>
#include <string>

#include "core/base/run_context.hpp"
#include "core/cell/cell.hpp"
#include "core/material/voxel_grid.hpp"

namespace sculpt {

/// In voxels of the grid that it was asked with.
struct CertifiedShare {
  std::uint64_t removable = 0;
  std::uint64_t held = 0;    ///< ball and shank have room and the arm a certified posture, along one direction at least
  std::uint64_t tool = 0;    ///< the tool alone has no room along any
  std::string home_contact;  ///< a sentence; empty if the cell's home is free

  double of_removable() const {
    return removable == 0 ? 1 : static_cast<double>(held) / static_cast<double>(removable);
  }
};

/// Not for translating robots, which are planned without fields. What is not held may still be reached in other ways
/// than a sweep goes: it is a lower bound of what sweeps can cut, but for the order of cuts and the ways between
/// directions, which only planning finds. Throws Cancelled, and InputError `tool_too_large`.
CertifiedShare certify_stand(const Cell& cell, const VoxelGrid& voxels, const RunContext& run);

}  // namespace sculpt
