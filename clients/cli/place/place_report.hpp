// What `sculpt place` found.
#pragma once

#include <vector>

#include "core/place/certify_stand.hpp"
#include "core/place/stand_study.hpp"
#include "core/place/turn_over.hpp"

namespace sculpt::cli {

/// What it refers to must outlive it.
struct PlaceReport {
  const Cell& cell;
  int joint;                                     ///< that was moved
  Stand own;                                     ///< of the cell
  const std::vector<RatedStand>& rated;          ///< best first
  const std::vector<CertifiedShare>& certified;  ///< of the first of those
  std::size_t best;                              ///< which of them is to be taken
  const std::vector<TurnOver>& turn_overs;       ///< there; empty if not asked for
};

/// In %.
inline double percent(std::uint64_t voxels, std::uint64_t of) {
  return of == 0 ? 100 : 100.0 * static_cast<double>(voxels) / static_cast<double>(of);
}

}  // namespace sculpt::cli
