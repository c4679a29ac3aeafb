// The figures of a report as a table for people.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/watch.hpp"
#include "proto/json.hpp"

namespace sculpt::cli {

/// What is said before planning, a line each; none where there is nothing to doubt.
std::vector<std::string> doubt_lines(const Doubts& doubts);

/// `report`: the object of `report --json`; fields that are missing are left out of the table.
std::string report_table(const Json& report);

}  // namespace sculpt::cli
