// Cell -> what a person should know of it before it is planned with.
#pragma once

#include "core/base/run_context.hpp"
#include "core/doctor/findings.hpp"
#include "core/sweep/field/field_store.hpp"

namespace sculpt {

struct ExamineSettings {
  int resolution = 64;
  int places_per_edge = 5;  ///< of the lattice that reach is sampled at
  bool fields = true;       ///< find the fields of the sweep planner, and how long that takes
  FieldStore store = {};    ///< of this cell, resolution and seed
};

/// Looks at everything that `plan` would, and at more; what is wrong becomes a fault with its cure, also where `plan`
/// refuses the cell. What is free is sampled: an estimate, unlike `field`, which is certified. Deterministic for a seed
/// but for the times. Throws Cancelled.
CellFindings examine_cell(const CellDraft& draft, const ExamineSettings& settings, const RunContext& run);

/// The same of a cell as files. What cannot be read is an error among the faults, and nothing else is found.
CellFindings examine_files(const CellFiles& files, const ExamineSettings& settings, const RunContext& run);

/// The findings of a cell that cannot be read.
CellFindings unreadable_cell(const std::string& name, const InputError& error);

}  // namespace sculpt
