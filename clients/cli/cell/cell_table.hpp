// The findings of a cell (cell.check, core/doctor/findings_json.hpp) in plain words.
#pragma once

#include <string>

#include "proto/json.hpp"

namespace sculpt::cli {

/// What it is made of, what is kept apart, home, reach and times; then the faults with their cures, errors first.
std::string cell_table(const Json& found);

/// Can it be planned with?
std::string cell_line(const Json& found);

/// The faults alone.
std::string fault_lines(const Json& found);

}  // namespace sculpt::cli
