#include "core/program/read/fanuc_reader.hpp"

#include <map>

#include "core/base/error.hpp"
#include "core/program/read/part_clauses.hpp"

namespace sculpt {

ReadPart read_fanuc(std::string_view text, std::size_t axes) {
  ReadPart part;
  std::vector<std::pair<int, double>> moves;  // position, seconds
  std::map<int, std::vector<double>> positions;
  int position = 0, lines = 0;
  bool ended = false, awaited = false, jumps = false, stops = false, aborts = false;
  for_lines(text, true, [&](ProgramLine& line) {
    if (line.take("P[")) {
      position = static_cast<int>(line.number());
      line.need("]{");
    } else if (position > 0 && line.take("};")) {
      if (positions[position].size() != axes) line.refuse("a position has another number of axes");
      position = 0;
    } else if (position > 0 && !line.take("GP1:") && !line.take("UF")) {
      while (!line.empty()) {
        if (!line.take("J")) line.need("E");
        line.number();
        line.need("=");
        positions[position].push_back(line.number());
        if (!line.take("deg")) line.need("mm");
        line.take(",");
      }
    } else if (position == 0 && !line.empty() && line.rest().front() >= '0' && line.rest().front() <= '9') {
      if (static_cast<int>(line.number()) != ++lines) line.refuse("the lines are not numbered one after the other");
      line.need(":");
      if (awaited) {
        awaited = false;
        line.need("PAUSE");
      } else if (jumps) {
        jumps = false;
        line.need("IF (R[90]>.01 OR R[90]<(-.01)),JMP LBL[999]");
      } else if (line.take("LBL[999]")) {
        stops = true;
      } else if (stops) {
        stops = false;
        line.need("ABORT");
        aborts = true;
      } else if (line.take("!VOXELS CUT ")) {
        take_voxels(line, part);
      } else if (line.take("!")) {
        awaited = line.rest().starts_with("MOUNT");
        if (awaited) part.tool = mounted(line, part);
      } else if (line.take("J P[")) {
        const int wanted = static_cast<int>(line.number());
        line.need("]");
        moves.emplace_back(wanted, line.number() / 1000);
        line.need("msec FINE");
        line.need(";");
      } else if (line.take("R[90]=PR[90,")) {
        line.number();
        line.need("]-(");
        take_start(line, part, line.number());
        jumps = true;
      }
    } else if (line.rest() == "/END") {
      ended = true;
    }
  });
  if (!ended) throw InputError("program_damaged", "a program has no /END: write it again");
  if (!part.start.empty() && !aborts)
    throw InputError("program_damaged", "a program does not stop where it does not begin: write it again");
  for (const auto& [wanted, seconds] : moves) {
    const auto found = positions.find(wanted);
    if (found == positions.end())
      throw InputError("program_damaged", "position " + std::to_string(wanted) + " is missing: write it again");
    part.moves.push_back({found->second, seconds, 0});
  }
  return part;
}

}  // namespace sculpt
