#include "core/program/read/part_reader.hpp"

#include <cmath>

#include "core/base/error.hpp"
#include "core/program/read/fanuc_reader.hpp"
#include "core/program/read/part_clauses.hpp"

namespace sculpt {
namespace {

ReadPart read_krl(std::string_view text, std::size_t axes) {
  ReadPart part;
  double override_percent = 100, percent = 0;
  bool ended = false, awaited = false;
  for_lines(text, true, [&](ProgramLine& line) {
    need_stop(line, awaited, "HALT");
    if (line.take("; VOXELS CUT ")) {
      take_voxels(line, part);
    } else if (line.rest().starts_with("; MOUNT")) {
      line.need("; ");
      part.tool = mounted(line, part);
      awaited = true;
    } else if (line.take("$OV_PRO=")) {
      override_percent = line.number();
    } else if (line.take("$VEL_AXIS[I]=")) {
      percent = line.number();
      if (percent != std::floor(percent) || percent < 1 || percent > 100) line.refuse("a speed is no whole percent");
    } else if (line.take("$VEL_EXTAX[")) {
      line.number();
      line.need("]=");
      if (line.number() != percent) line.refuse("an external axis has another speed");
    } else if (line.take("IF ABS($AXIS_ACT.")) {
      line.need(part.start.size() < 6 ? "A" : "E");
      line.number();
      line.need("-(");
      take_start(line, part, as_float(line.number()));
      line.need("))>0.01 THEN");
      awaited = true;
    } else if (line.take("PTP {")) {
      ReadMove move;
      for (std::size_t at = 0; at < axes; ++at) {
        if (at > 0) line.need(",");
        line.need((at < 6 ? "A" + std::to_string(at + 1) : "E" + std::to_string(at - 5)) + " ");
        move.values.push_back(as_float(line.number()));
      }
      line.need("}");
      if (!line.empty()) line.refuse("there is more behind a PTP: it would not stop there");
      move.share = percent / 100 * override_percent / 100;
      part.moves.push_back(std::move(move));
    } else if (line.rest() == "END") {
      ended = true;
    }
  });
  if (!ended) throw InputError("program_damaged", "a program has no END: write it again");
  return part;
}

ReadPart read_rapid(std::string_view text, std::size_t axes) {
  ReadPart part;
  bool ended = false, awaited = false;
  for_lines(text, true, [&](ProgramLine& line) {
    need_stop(line, awaited, "Stop;");
    if (line.take("! VOXELS CUT ")) {
      take_voxels(line, part);
    } else if (line.take("TPWrite \"")) {
      part.tool = mounted(line, part);
      awaited = true;
    } else if (line.take("IF Abs(here.")) {
      if (!line.take("robax.rax_")) line.need("extax.eax_");
      const std::string_view rest = line.rest();
      const std::size_t at = rest.find("-(");
      if (at == std::string_view::npos) line.refuse("a check of the start is damaged");
      line.need(rest.substr(0, at + 2));
      take_start(line, part, as_float(line.number()));
      line.need("))>0.01 THEN");
      awaited = true;
    } else if (line.take("MoveAbsJ [[")) {
      ReadMove move;
      for (std::size_t at = 0; at < 12; ++at) {
        if (at == 6)
          line.need("],[");
        else if (at > 0)
          line.need(",");
        if (at < axes)
          move.values.push_back(as_float(line.number()));
        else
          line.need("9E9");
      }
      line.need("]]\\NoEOffs,v1000\\T:=");
      move.seconds = as_float(line.number());
      line.need(",fine,tool0;");
      if (!line.empty()) line.refuse("there is more behind a move");
      part.moves.push_back(std::move(move));
    } else if (line.rest() == "ENDMODULE") {
      ended = true;
    }
  });
  if (!ended) throw InputError("program_damaged", "a module has no ENDMODULE: write it again");
  return part;
}

ReadPart read_urscript(std::string_view text) {
  ReadPart part;
  part.radians = true;
  bool ended = false, awaited = false, told = false;
  for_lines(text, false, [&](ProgramLine& line) {
    const bool is_outer_end = line.rest() == "end";  // others are indented
    line.blanks();
    need_stop(line, told, "halt");
    told = awaited;
    need_stop(line, awaited, "popup(");
    if (line.take("# VOXELS CUT ")) {
      take_voxels(line, part);
    } else if (line.rest().starts_with("popup(\"MOUNT")) {
      line.need("popup(\"");
      part.tool = mounted(line, part);
      if (!line.rest().ends_with("blocking=True)")) line.refuse("it goes on before the tool is mounted");
    } else if (line.take("if norm(here[")) {
      line.number();
      line.need("] - (");
      take_start(line, part, line.number());
      line.need(")) > 0.00018:");
      awaited = true;
    } else if (line.take("movej([")) {
      ReadMove move;
      for (int at = 0; at < 6; ++at) {
        if (at > 0) line.need(",");
        move.values.push_back(line.number());
      }
      line.need("], t=");
      move.seconds = line.number();
      line.need(")");
      if (!line.empty()) line.refuse("there is more behind a move: it would be blended");
      part.moves.push_back(std::move(move));
    } else if (is_outer_end) {
      ended = true;
    }
  });
  if (!ended) throw InputError("program_damaged", "a script has no end: write it again");
  return part;
}

ReadPart read_gcode(std::string_view text, const std::vector<std::string>& letters) {
  ReadPart part;
  bool ended = false, by_time = false, awaited = false;
  for_lines(text, false, [&](ProgramLine& line) {
    need_stop(line, awaited, "(ABORT,");
    if (line.take("; VOXELS CUT ")) {
      take_voxels(line, part);
    } else if (line.take("T")) {
      const double number = line.number();
      line.need("M6 ; ");
      part.tool = mounted(line, part);
      if (part.tool != number) line.refuse("two numbers of a tool");
    } else if (line.rest() == "G93") {
      by_time = true;
    } else if (line.rest() == "G94") {
      by_time = false;
    } else if (line.take("o1") && line.rest().find("if [ABS[#54") != std::string_view::npos) {
      const std::size_t at = line.rest().find("- [");
      if (at == std::string_view::npos) line.refuse("a check of the start is damaged");
      ProgramLine value(line.rest().substr(at + 3), 0);
      take_start(line, part, value.number());
      value.need("]] GT 0.01]");
      awaited = true;
    } else if (line.take("G1 ")) {
      if (!by_time) line.refuse("a move is not by time");
      ReadMove move;
      for (const std::string& letter : letters) {
        line.need(letter);
        move.values.push_back(line.number());
      }
      line.need("F");
      const double moves_a_minute = line.number();
      if (!(moves_a_minute > 0)) line.refuse("a feed is not above 0");
      move.seconds = 60 / moves_a_minute;
      if (!line.empty()) line.refuse("there is more behind a move");
      part.moves.push_back(std::move(move));
    } else if (line.rest() == "M2") {
      ended = true;
    }
  });
  if (!ended) throw InputError("program_damaged", "a program has no M2: write it again");
  return part;
}

}  // namespace

ReadPart read_part(Dialect dialect, std::string_view text, const std::vector<std::string>& letters) {
  switch (dialect) {
    case Dialect::krl:
      return read_krl(text, letters.size());
    case Dialect::rapid:
      return read_rapid(text, letters.size());
    case Dialect::urscript:
      return read_urscript(text);
    case Dialect::fanuc:
      return read_fanuc(text, letters.size());
    case Dialect::gcode:
      return read_gcode(text, letters);
    case Dialect::ros2:
      break;
  }
  throw InputError("program_damaged", "ROS trajectories have no moves");
}

}  // namespace sculpt
