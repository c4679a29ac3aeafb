// A program of each dialect with moves, made of paths that no planner made.
#pragma once

#include <gtest/gtest.h>

#include <map>

#include "core/base/error.hpp"
#include "core/program/make_program.hpp"
#include "core/program/read/part_reader.hpp"
#include "tests/core/timing/made_up_paths.hpp"

namespace sculpt {

struct Made {
  std::map<std::string, std::string> files;
  ProgramReport report;
};

inline Made make(const PlanPath& path, const Cell& cell, ProgramDemands demands) {
  Made made;
  made.report = make_program(path, cell, demands, [&](const ProgramFile& file) {
    EXPECT_FALSE(made.files.contains(file.name)) << file.name;
    made.files[file.name] = file.text;
  });
  return made;
}

inline std::string refusal(const PlanPath& path, const Cell& cell, const ProgramDemands& demands) {
  try {
    make(path, cell, demands);
    return "accepted";
  } catch (const InputError& error) {
    return error.code() + ": " + error.what();
  }
}

struct Case {
  Dialect dialect;
  const char* cell;
  std::vector<std::string> letters;
};

inline const std::vector<Case> cases{
    {Dialect::krl, "six-axis-turntable", {"A1", "A2", "A3", "A4", "A5", "A6", "E1"}},
    {Dialect::rapid, "six-axis-turntable", {"A1", "A2", "A3", "A4", "A5", "A6", "E1"}},
    {Dialect::fanuc, "six-axis-turntable", {"A1", "A2", "A3", "A4", "A5", "A6", "E1"}},
    {Dialect::urscript, "ur10e-plinth", {"J1", "J2", "J3", "J4", "J5", "J6"}},
    {Dialect::gcode, "gantry", {"X", "Y", "Z"}},
};

inline ProgramDemands demands_of(Dialect dialect) {
  ProgramDemands demands;
  demands.dialect = dialect;
  demands.name = "bust";
  demands.motion = {0.05, 0.5, {}, 0};
  demands.seams_in_stock = true;  // these paths are certified by nobody
  return demands;
}

// Parts of a program, in their order.
inline std::vector<ReadPart> read_parts(const Case& one, const Made& made) {
  std::vector<ReadPart> parts;
  for (std::size_t part = 1; part <= made.report.parts; ++part)
    parts.push_back(read_part(
        one.dialect, made.files.at(ProgramNames{"bust", part, 0, {}}.part_name() + facts_of(one.dialect).extension),
        one.letters));
  return parts;
}

}  // namespace sculpt
