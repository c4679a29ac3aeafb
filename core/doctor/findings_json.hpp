// Findings as one line of JSON, for programs.
#pragma once

#include <string>

#include "core/doctor/findings.hpp"

namespace sculpt {

/// One object; proto/schema.json names its fields. Lengths in m, angles in rad.
std::string findings_json(const CellFindings& findings);

}  // namespace sculpt
