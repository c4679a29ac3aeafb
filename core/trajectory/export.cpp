#include "core/trajectory/export.hpp"

#include <ostream>
#include <string>

#include "core/trajectory/binary/binary.hpp"
#include "core/trajectory/reader.hpp"
#include "core/trajectory/trajectory_line.hpp"
#include "core/trajectory/writer.hpp"

namespace sculpt {
namespace {

// A field as RFC 4180 wants it: joint names may hold commas or quotes.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_row(const Keyframe& keyframe) {
  std::string row = keyframe.cut ? "cut" : "move";
  for (double value : keyframe.q) {
    row += ',';
    append_number(row, value);
  }
  for (Voxel voxel : {keyframe.first, keyframe.last})
    for (int index : {voxel.i, voxel.j, voxel.k}) {
      row += ',';
      if (keyframe.cut) row += std::to_string(index);
    }
  return row + "\n";
}

}  // namespace

void export_csv(std::istream& in, std::ostream& csv) {
  TrajectoryReader reader(in);
  csv << "# sculpt trajectory: each row is a linear joint motion from the row before it, the first one starts at home\n"
         "# joints in rad or m; a cut removes the straight run of voxels first..last\n"
         "# "
      << header_line(reader.header()) << "\ntype";
  for (const std::string& joint : reader.header().joints) csv << ',' << csv_field(joint);
  csv << ",first_i,first_j,first_k,last_i,last_j,last_k\n";
  while (const auto keyframe = reader.next()) csv << csv_row(*keyframe);
}

void export_binary(std::istream& in, std::ostream& sct) {
  TrajectoryReader reader(in);
  BinaryWriter writer(sct, reader.header());
  while (const auto keyframe = reader.next()) writer.add(*keyframe);
  writer.finish();
}

void export_text(std::istream& in, std::ostream& ndjson) {
  TrajectoryReader reader(in);
  TrajectoryWriter writer(ndjson, reader.header());
  while (const auto keyframe = reader.next()) writer.add(*keyframe);
  writer.finish();
}

}  // namespace sculpt
