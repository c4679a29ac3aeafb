// The figures of a report as a table for people.
#pragma once

#include <cstdint>
#include <string>

#include "proto/json.hpp"

namespace sculpt {

/// What is said before planning where `voxels` of the target, more than none, hang on nothing.
std::string loose_keep_warning(std::uint64_t voxels);

/// `report`: the object of `report --json`; fields that are missing are left out of the table.
std::string report_table(const Json& report);

}  // namespace sculpt
