// A trajectory in its other forms: CSV for spreadsheets and controllers, .sct (compact binary). docs/trajectory.md
// describes all three.
#pragma once

#include <iosfwd>

namespace sculpt {

/// All three throw InputError `trajectory_invalid` for input that is not what it should be; what was written to the
/// output until then is to be thrown away. Streams are read and written once, in order; binary streams must be opened
/// as such.
void export_csv(std::istream& ndjson, std::ostream& csv);
void export_binary(std::istream& ndjson, std::ostream& sct);

/// The way back: gives the very bytes that TrajectoryWriter wrote.
void import_binary(std::istream& sct, std::ostream& ndjson);

}  // namespace sculpt
