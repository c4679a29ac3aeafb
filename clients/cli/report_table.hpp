// The figures of a report as a table for people.
#pragma once

#include <string>

#include "proto/json.hpp"

namespace sculpt {

/// `report`: the object of `report --json`; fields that are missing are left out of the table.
std::string report_table(const Json& report);

}  // namespace sculpt
