// One pass along a tilted tool direction.
#pragma once

#include "core/sweep/pass.hpp"

namespace sculpt {

/// Cuts what it can of `wanted`, in sorties from the hub and back. Nothing is done where the arm finds no way to the
/// direction. Deterministic, also in the number of threads. Throws Cancelled.
PassEnd cut_tilted(Carving& carving, const PostureField& field, const std::vector<Voxel>& wanted);

}  // namespace sculpt
