#include "core/program/write/part_writer.hpp"

#include <stdexcept>

namespace sculpt {
namespace {

std::string numbered(const std::string& program, std::size_t part) {
  std::string number = std::to_string(part);
  return program + "_" + std::string(number.size() < 4 ? 4 - number.size() : 0, '0') + number;
}

std::string krl_main(const std::string& name, std::size_t parts) {
  std::string text = "&ACCESS RVP\r\n&REL 1\r\nDEF " + name +
                     "()\r\n; calls the parts from NEXT_PART on, which is kept over a power cut\r\nWHILE NEXT_PART<=" +
                     std::to_string(parts) + "\r\n  SWITCH NEXT_PART\r\n";
  for (std::size_t part = 1; part <= parts; ++part)
    text += "    CASE " + std::to_string(part) + "\r\n      " + numbered(name, part) + "()\r\n";
  return text + "  ENDSWITCH\r\n  NEXT_PART=NEXT_PART+1\r\nENDWHILE\r\nNEXT_PART=1\r\nEND\r\n";
}

std::string rapid_main(const std::string& name, std::size_t parts) {
  return "MODULE " + name +
         "\r\n  ! calls the parts from next_part on, which is kept over a power cut\r\n  PERS num next_part:=1;\r\n" +
         "  PROC " + name + "_main()\r\n    VAR string part;\r\n    WHILE next_part<=" + std::to_string(parts) +
         " DO\r\n      part:=NumToStr(next_part,0);\r\n      WHILE StrLen(part)<4 DO\r\n        part:=\"0\"+part;\r\n  "
         "    ENDWHILE\r\n" +
         "      part:=\"" + name + "_\"+part;\r\n      Load \\Dynamic,\"HOME:/" + name +
         "/\"\\File:=part+\".mod\";\r\n      %part+\"_run\"%;\r\n      UnLoad \"HOME:/" + name +
         "/\"\\File:=part+\".mod\";\r\n      next_part:=next_part+1;\r\n    ENDWHILE\r\n    next_part:=1;\r\n  "
         "ENDPROC\r\nENDMODULE\r\n";
}

std::string fanuc_main(const std::string& name, std::size_t parts) {
  std::string lines;
  std::size_t count = 0;
  const auto add = [&](const std::string& text) {
    std::string number = std::to_string(++count);
    lines += std::string(number.size() < 4 ? 4 - number.size() : 0, ' ') + number + ":  " + text + " ;\r\n";
  };
  add("!R[1]: NEXT PART, OUTLIVES POWER");
  add("IF R[1]>0,JMP LBL[32000]");
  add("R[1]=1");
  add("LBL[32000]");
  for (std::size_t part = 1; part <= parts; ++part) {
    add("IF R[1]<>" + std::to_string(part) + ",JMP LBL[" + std::to_string(part) + "]");
    add("CALL " + numbered(name, part));
    add("R[1]=R[1]+1");
    add("LBL[" + std::to_string(part) + "]");
  }
  add("R[1]=1");
  return "/PROG  " + name + "\r\n/ATTR\r\nCOMMENT = \"sculpt\";\r\nLINE_COUNT = " + std::to_string(count) +
         ";\r\nDEFAULT_GROUP = *,*,*,*,*;\r\n/MN\r\n" + lines + "/POS\r\n/END\r\n";
}

std::string gcode_main(const std::string& name, std::size_t parts) {
  std::string text =
      "; calls the parts from #4000 on; list 4000 in the parameter file, and it is kept over a power cut\n"
      "o1 if [#4000 LT 1]\n  #4000 = 1\no1 endif\n";
  for (std::size_t part = 1; part <= parts; ++part)
    text += "o" + std::to_string(part + 1) + " if [#4000 EQ " + std::to_string(part) + "]\n  o<" +
            numbered(name, part) + "> call\n  #4000 = " + std::to_string(part + 1) + "\no" + std::to_string(part + 1) +
            " endif\n";
  return text + "#4000 = 1\nM2\n";
}

}  // namespace

std::string ToolMount::text() const {
  std::string text = "MOUNT TOOL " + std::to_string(number) + " ";
  for (const char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    text += plain ? c : ' ';
  }
  return text;
}

std::string VoxelsCut::text_before() const {
  return "VOXELS CUT BEFORE " + std::to_string(before);
}

std::string VoxelsCut::text_after() const {
  return "VOXELS CUT AFTER " + std::to_string(after);
}

std::string ProgramNames::part_name() const {
  return numbered(program, part);
}

std::unique_ptr<PartWriter> write_part(Dialect dialect, const AxisLayout& layout, const ProgramNames& names,
                                       const Configuration& start) {
  switch (dialect) {
    case Dialect::krl:
      return krl_part(layout, names, start);
    case Dialect::rapid:
      return rapid_part(layout, names, start);
    case Dialect::urscript:
      return urscript_part(layout, names, start);
    case Dialect::fanuc:
      return fanuc_part(layout, names, start);
    case Dialect::gcode:
      return gcode_part(layout, names, start);
    case Dialect::ros2:
      break;
  }
  throw std::logic_error("ROS trajectories are no programs of moves");
}

std::vector<ProgramFile> write_main(Dialect dialect, const std::string& program, std::size_t parts) {
  switch (dialect) {
    case Dialect::krl:
      return {{program + ".src", krl_main(program, parts)},
              {program + ".dat",
               "&ACCESS RVP\r\n&REL 1\r\nDEFDAT " + program + " PUBLIC\r\nDECL GLOBAL INT NEXT_PART=1\r\nENDDAT\r\n"}};
    case Dialect::rapid:
      return {{program + ".mod", rapid_main(program, parts)}};
    case Dialect::fanuc:
      return {{program + ".ls", fanuc_main(program, parts)}};
    case Dialect::gcode:
      return {{program + ".ngc", gcode_main(program, parts)}};
    case Dialect::urscript:
    case Dialect::ros2:
      break;
  }
  return {};
}

}  // namespace sculpt
