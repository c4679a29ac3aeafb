// Small jobs with milling tools, and their plans as text.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/plan/plan.hpp"
#include "core/verify/mill/machined_surface.hpp"

namespace sculpt::milled {

std::string read(const std::filesystem::path& path);

/// Of this process, in the folder for temporary files.
std::filesystem::path scratch(const std::string& name);

/// A sample mesh in a block of this side, in the cell `studio`.
Job make_job(const std::string& mesh, int n, const std::vector<std::string>& tools, double side_m = 0.05);
/// The same with a part that is given as STL, mm.
Job make_job_of(const std::string& stl, int n, const std::vector<std::string>& tools, double side_m = 0.05);

/// Changes a tool of its library by a JSON merge patch (RFC 7396).
void change_tool(Job& job, const std::string& name, const std::string& patch);

struct Milled {
  Job job;
  JobResult result;
  MachinedSurface surface;
};
/// Planned on two threads; prints what the replay finds.
Milled mill(Job job);

/// A vertex where it was moved to, and how far (mm, from the block's corner).
struct Moved {
  double x, y, z, excess;
};
/// What stands above those vertices that are meant, the least first (mm).
std::vector<double> excess_at(const Milled& milled, const std::function<bool(const Moved&)>& is_meant);
double share_within(const std::vector<double>& excess_mm, double most_mm);

}  // namespace sculpt::milled
