#include "core/trajectory/export.hpp"

#include <ostream>
#include <string>

#include "core/trajectory/binary/binary.hpp"
#include "core/trajectory/quantum.hpp"
#include "core/trajectory/reader.hpp"
#include "core/trajectory/text/number_text.hpp"
#include "core/trajectory/text/trajectory_line.hpp"
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

std::string type_and_joints(const Keyframe& keyframe, const char* type) {
  std::string row = type;
  for (double value : keyframe.q) {
    row += ',';
    append_number(row, value);
  }
  return row;
}

std::string csv_row(const Keyframe& keyframe) {
  std::string row = type_and_joints(keyframe, keyframe.cut ? "cut" : "move");
  for (Voxel voxel : {keyframe.first, keyframe.last})
    for (int index : {voxel.i, voxel.j, voxel.k}) {
      row += ',';
      if (keyframe.cut) row += std::to_string(index);
    }
  return row + "\n";
}

std::string csv_row(const Keyframe& keyframe, const MillHeader& header) {
  const MillStep& step = *keyframe.mill;
  std::string row = type_and_joints(keyframe, step.is_change() ? "tool" : keyframe.cut ? "cut" : "move") + ',';
  if (step.is_change()) row += csv_field(header.tools[static_cast<std::size_t>(step.tool)].name);
  row += ',';
  if (step.is_placed()) row += std::to_string(step.direction);
  for (const std::int64_t quanta : step.tip) {
    row += ',';
    if (step.is_placed()) append_number(row, from_quanta(quanta));
  }
  row += ',';
  if (keyframe.cut) row += std::to_string(step.removed);
  return row + "\n";
}

}  // namespace

void export_csv(std::istream& in, std::ostream& csv) {
  TrajectoryReader reader(in);
  const auto& mill = reader.header().mill;
  csv << "# sculpt trajectory: each row is a linear joint motion from the row before it, the first one starts at home\n"
      << (mill ? "# joints in rad or m; a cut removes what the cutter sweeps from the tip before to this one (m)\n"
               : "# joints in rad or m; a cut removes the straight run of voxels first..last\n")
      << "# " << header_line(reader.header()) << "\ntype";
  for (const std::string& joint : reader.header().joints) csv << ',' << csv_field(joint);
  csv << (mill ? ",tool,direction,tip_x,tip_y,tip_z,removed\n" : ",first_i,first_j,first_k,last_i,last_j,last_k\n");
  while (const auto keyframe = reader.next()) csv << (mill ? csv_row(*keyframe, *mill) : csv_row(*keyframe));
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
