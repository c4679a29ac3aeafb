// What the server wants from the planner, as functions: tests give it another one.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "core/plan/intake.hpp"
#include "core/plan/plan.hpp"
#include "core/program/program_demands.hpp"
#include "core/verify/verify.hpp"

namespace sculpt::server {

inline constexpr const char* timeline_file = "timeline.tokens";

/// A finished plan, besides trajectory and timeline: the content of its other artifacts, and whether the replay was
/// clean.
struct PlanFiles {
  std::string report_json, residue_ndjson;
  std::string voxels_binvox, stock_binvox;  ///< the target, and what stands at the end
  bool clean = false;
  std::uint64_t collisions = 0;
  std::string first_finding;
  std::optional<InputError> unkept;  ///< what a clean plan does not keep of what the job asks for
};

struct Replay {
  bool clean = false;
  std::uint64_t collisions = 0, voxels_checked = 0;
  std::vector<Finding> findings;
  std::vector<ExemptPair> exempt_pairs;
};

/// All throw InputError, and Cancelled where they take a watch; all are called from several threads at once.
struct Planner {
  /// Names of the cells that `read_cell` knows.
  std::function<std::vector<std::string>()> cells;
  std::function<CellFiles(const std::string& name)> read_cell;
  /// The tool libraries that clients are offered.
  std::function<std::vector<ToolLibraryFile>()> tool_libraries;
  std::function<void(const Job&, const Watch&)> check;
  /// What is found out about a cell, as a JSON object; what is wrong with its files is found too.
  std::function<std::string(const CellFiles&, int resolution, int threads)> examine;
  /// Bytes that a job needs.
  std::function<std::uint64_t(const JobSizes&)> predict_memory;
  /// Goes on where a run of the job with the same trajectory file was stopped or killed. Leaves its checkpoints and the
  /// timeline beside the trajectory.
  std::function<PlanFiles(const Job&, const std::filesystem::path& trajectory, const Watch&)> run;
  std::function<Replay(const Job&, const std::filesystem::path& trajectory, const Watch&)> verify;
  /// Writes the time law of a job that has `motion` (core/law/law_file).
  std::function<void(const Job&, const std::filesystem::path& trajectory, const std::filesystem::path& law)> time;
  /// Writes the robot program of a job that has `motion`, as a .zip of a folder of the program's name.
  std::function<void(const Job&, const ProgramDemands&, const std::filesystem::path& trajectory,
                     const std::filesystem::path& zip)>
      program;
  /// Of a job with milling tools: the surface as machined (.ply), and a .zip of the stock after each tool (.binvox).
  std::function<void(const Job&, const std::filesystem::path&trajectory, const std::filesystem::path&file)> surface,
      stocks;
  /// ndjson in, other format out.
  std::function<void(std::istream&, std::ostream&)> to_csv, to_binary;
};

/// The real one. `cell_folders` are searched in order.
Planner make_planner(std::vector<std::filesystem::path> cell_folders);

}  // namespace sculpt::server
