// Findings -> what is wrong with a cell, and the cure of each fault in a sentence.
#pragma once

#include "core/doctor/findings.hpp"

namespace sculpt {

/// Of what was read: bodies, joints beside the chain, tool. Adds to `found.faults`, as all of these do.
void find_faults_of_files(const CellDraft& draft, CellFindings& found);

/// Is home blocked, at fault, or at a place where no plan should begin?
bool home_is_poor(const CellDraft& draft, const CellFindings& found);
/// With `found.better_home`, if there is one, as the cure.
void find_faults_of_home(const CellDraft& draft, CellFindings& found);

/// Would another place of the table be worth looking for?
bool reach_is_poor(const CellFindings& found);
void find_faults_of_reach(const Chain& chain, CellFindings& found);

}  // namespace sculpt
