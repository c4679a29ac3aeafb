#include "core/program/read/main_reader.hpp"

#include <deque>

#include "core/program/read/program_line.hpp"

namespace sculpt {
namespace {

/// The lines of a program that are neither empty nor a comment, taken in their order.
class Statements {
 public:
  Statements(std::string_view text, bool carriage_returns, std::string_view comment) {
    for_lines(text, carriage_returns, [&](ProgramLine& line) {
      if (!line.empty() && !line.rest().starts_with(comment)) lines_.push_back(line);
    });
  }

  explicit Statements(std::deque<ProgramLine> lines) : lines_(std::move(lines)) {}

  bool ended() const { return lines_.empty(); }
  bool next_is(std::string_view word) { return !lines_.empty() && lines_.front().rest().starts_with(word); }
  ProgramLine take() {
    if (lines_.empty()) throw InputError("program_damaged", "a main program ends too early: write it again");
    ProgramLine line = lines_.front();
    lines_.pop_front();
    return line;
  }
  /// The next one is just that.
  void need(const std::string& text) {
    ProgramLine line = take();
    line.need(text);
    end(line);
  }
  /// It begins with `before`; gives what stands between that and `behind`.
  std::string between(std::string_view before, std::string_view behind) {
    ProgramLine line = take();
    line.need(before);
    const std::string_view rest = line.rest();
    if (rest.size() < behind.size() || !rest.ends_with(behind)) line.refuse("it does not end as it should");
    return std::string(rest.substr(0, rest.size() - behind.size()));
  }
  static void end(ProgramLine& line) {
    if (!line.empty()) line.refuse("there is more than there should be");
  }

 private:
  std::deque<ProgramLine> lines_;
};

std::string plain(std::size_t number) {
  return std::to_string(number);
}

std::vector<std::string> read_krl_main(std::string_view text, std::string_view data) {
  Statements kept(data, true, ";");
  kept.need("&ACCESS RVP");
  kept.need("&REL 1");
  const std::string name = kept.between("DEFDAT ", " PUBLIC");
  kept.need("DECL GLOBAL INT NEXT_PART=1");
  kept.need("ENDDAT");
  Statements program(text, true, ";");
  program.need("&ACCESS RVP");
  program.need("&REL 1");
  program.need("DEF " + name + "()");
  const std::string count = program.between("WHILE NEXT_PART<=", "");
  program.need("SWITCH NEXT_PART");
  std::vector<std::string> parts;
  while (program.next_is("CASE ")) {
    program.need("CASE " + plain(parts.size() + 1));
    parts.push_back(program.between("", "()"));
  }
  if (count != plain(parts.size())) throw InputError("program_damaged", "a main program leaves out parts");
  for (const char* line : {"ENDSWITCH", "NEXT_PART=NEXT_PART+1", "ENDWHILE", "NEXT_PART=1", "END"}) program.need(line);
  return parts;
}

std::vector<std::string> read_rapid_main(std::string_view text) {
  Statements program(text, true, "!");
  const std::string name = program.between("MODULE ", "");
  program.need("PERS num next_part:=1;");
  program.need("PROC " + name + "_main()");
  program.need("VAR string part;");
  ProgramLine loop = program.take();
  loop.need("WHILE next_part<=");
  const double count = loop.number();
  loop.need("DO");
  Statements::end(loop);
  for (const char* line : {"part:=NumToStr(next_part,0);", "WHILE StrLen(part)<4 DO", "part:=\"0\"+part;", "ENDWHILE"})
    program.need(line);
  const std::string stem = program.between("part:=\"", "\"+part;");
  program.need("Load \\Dynamic,\"HOME:/" + name + "/\"\\File:=part+\".mod\";");
  program.need("%part+\"_run\"%;");
  program.need("UnLoad \"HOME:/" + name + "/\"\\File:=part+\".mod\";");
  for (const char* line : {"next_part:=next_part+1;", "ENDWHILE", "next_part:=1;", "ENDPROC", "ENDMODULE"})
    program.need(line);
  std::vector<std::string> parts;
  for (std::size_t part = 1; static_cast<double>(part) <= count; ++part) {
    std::string number = plain(part);
    while (number.size() < 4) number.insert(0, "0");
    parts.push_back(stem + number);
  }
  return parts;
}

/// Without their numbers and ends, and without remarks.
Statements fanuc_statements(std::string_view text) {
  std::deque<ProgramLine> lines;
  std::size_t number = 0;
  for_lines(text, true, [&](ProgramLine& line) {
    if (line.empty() || line.rest().front() < '0' || line.rest().front() > '9') return;
    if (line.number() != static_cast<double>(++number)) line.refuse("the lines are not numbered in order");
    line.need(":");
    if (line.empty() || !line.rest().ends_with(" ;")) line.refuse("a line has no end");
    if (!line.rest().starts_with("!")) lines.emplace_back(line.rest().substr(0, line.rest().size() - 2), number);
  });
  if (!text.ends_with("/END\r\n")) throw InputError("program_damaged", "a main program has no /END: write it again");
  return Statements(std::move(lines));
}

std::vector<std::string> read_fanuc_main(std::string_view text) {
  Statements program = fanuc_statements(text);
  for (const char* line : {"IF R[1]>0,JMP LBL[32000]", "R[1]=1", "LBL[32000]"}) program.need(line);
  std::vector<std::string> parts;
  while (program.next_is("IF R[1]<>")) {
    const std::string number = plain(parts.size() + 1);
    program.need("IF R[1]<>" + number + ",JMP LBL[" + number + "]");
    parts.push_back(program.between("CALL ", ""));
    program.need("R[1]=R[1]+1");
    program.need("LBL[" + number + "]");
  }
  program.need("R[1]=1");
  if (!program.ended()) program.take().refuse("there is more than there should be");
  return parts;
}

std::vector<std::string> read_gcode_main(std::string_view text) {
  Statements program(text, false, ";");
  program.need("o1 if [#4000 LT 1]");
  program.need("#4000 = 1");
  program.need("o1 endif");
  std::vector<std::string> parts;
  while (program.next_is("o")) {
    const std::string label = "o" + plain(parts.size() + 2);
    program.need(label + " if [#4000 EQ " + plain(parts.size() + 1) + "]");
    parts.push_back(program.between("o<", "> call"));
    program.need("#4000 = " + plain(parts.size() + 1));
    program.need(label + " endif");
  }
  program.need("#4000 = 1");
  program.need("M2");
  return parts;
}

}  // namespace

std::vector<std::string> read_main(Dialect dialect, std::string_view text, std::string_view data) {
  switch (dialect) {
    case Dialect::krl:
      return read_krl_main(text, data);
    case Dialect::rapid:
      return read_rapid_main(text);
    case Dialect::fanuc:
      return read_fanuc_main(text);
    case Dialect::gcode:
      return read_gcode_main(text);
    case Dialect::urscript:
    case Dialect::ros2:
      break;
  }
  throw InputError("program_damaged", "there is no main program in this dialect");
}

}  // namespace sculpt
