// Small jobs with milling tools, and their plans as text.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/plan/plan.hpp"

namespace sculpt::milled {

std::string read(const std::filesystem::path& path);

/// Of this process, in the folder for temporary files.
std::filesystem::path scratch(const std::string& name);

/// A sample mesh in a block of 50 mm, in the cell `studio`.
Job make_job(const std::string& mesh, int n, const std::vector<std::string>& tools);

}  // namespace sculpt::milled
