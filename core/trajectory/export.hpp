// A trajectory in its other forms: CSV for spreadsheets and controllers, .sct (compact binary), .ndjson.
// docs/trajectory.md describes all three.
#pragma once

#include <iosfwd>

namespace sculpt {

/// From .ndjson or .sct. All three throw InputError `trajectory_invalid` for input that is not what it should be; what
/// was written to the output until then is to be thrown away. Streams are read and written once, in order; binary
/// streams must be opened as such.
void export_csv(std::istream& in, std::ostream& csv);
/// Joint values must be multiples of the quantum, as those of TrajectoryWriter's callers are.
void export_binary(std::istream& in, std::ostream& sct);
/// From .sct: the very bytes that TrajectoryWriter wrote.
void export_text(std::istream& in, std::ostream& ndjson);

}  // namespace sculpt
