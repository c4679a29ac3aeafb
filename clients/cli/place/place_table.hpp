// What `sculpt place` found as text: for people the best stands and a map, for programs all of it.
#pragma once

#include <string>

#include "clients/cli/place/place_report.hpp"

namespace sculpt::cli {

/// The first `rows` and the cell's own stand, a line each, and a map of x and y.
std::string place_table(const PlaceReport& report, int rows);

/// One JSON document: every stand.
std::string place_json(const PlaceReport& report);

}  // namespace sculpt::cli
