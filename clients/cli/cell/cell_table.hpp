// The findings of a cell in plain words.
#pragma once

#include <string>

#include "core/doctor/findings.hpp"

namespace sculpt::cli {

/// What it is made of, what is kept apart, home, reach and times; then the faults with their cures, errors first.
std::string cell_table(const CellFindings& found);

/// Can it be planned with?
std::string cell_line(const CellFindings& found);

/// The faults alone.
std::string fault_lines(const CellFindings& found);

}  // namespace sculpt::cli
