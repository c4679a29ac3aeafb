// What `sculpt place` found: for people the best stands and a map, for programs all of it.
#pragma once

#include <string>
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

/// The first `rows` and the cell's own stand, a line each, and a map of x and y.
std::string place_table(const PlaceReport& report, int rows);

/// One JSON document: every stand.
std::string place_json(const PlaceReport& report);

}  // namespace sculpt::cli
