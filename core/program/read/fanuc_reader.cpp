#include "core/program/read/fanuc_reader.hpp"

#include <map>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/program/read/part_clauses.hpp"

namespace sculpt {
namespace {

/// What is read of a part so far, and where in it the reader stands.
class FanucLines {
 public:
  explicit FanucLines(std::size_t axes) : axes_(axes) {}

  void take(ProgramLine& line) {
    if (line.take("P[")) {
      open_ = static_cast<int>(line.number());
      line.need("]{");
    } else if (open_ > 0) {
      take_position(line);
    } else if (!line.empty() && line.rest().front() >= '0' && line.rest().front() <= '9') {
      if (static_cast<int>(line.number()) != ++lines_) line.refuse("the lines are not numbered one after the other");
      line.need(":");
      take_statement(line);
    } else if (line.rest() == "/END") {
      ended_ = true;
    }
  }

  /// Throws InputError "program_damaged".
  ReadPart finish() {
    if (!ended_) throw InputError("program_damaged", "a program has no /END: write it again");
    if (!part_.start.empty() && !aborts_)
      throw InputError("program_damaged", "a program does not stop where it does not begin: write it again");
    for (const auto& [wanted, seconds] : moves_) {
      const auto found = positions_.find(wanted);
      if (found == positions_.end())
        throw InputError("program_damaged", "position " + std::to_string(wanted) + " is missing: write it again");
      part_.moves.push_back({found->second, seconds, 0});
    }
    return std::move(part_);
  }

 private:
  /// The statement that must be in the very next line.
  enum class Owed : std::uint8_t { none, pause, jump, abort };

  void take_position(ProgramLine& line) {
    std::vector<double>& position = positions_[open_];
    if (line.take("};")) {
      if (position.size() != axes_) line.refuse("a position has another number of axes");
      open_ = 0;
    } else if (!line.take("GP1:") && !line.take("UF")) {
      while (!line.empty()) {
        if (!line.take("J")) line.need("E");
        line.number();
        line.need("=");
        position.push_back(line.number());
        if (!line.take("deg")) line.need("mm");
        line.take(",");
      }
    }
  }

  void take_statement(ProgramLine& line) {
    switch (std::exchange(owed_, Owed::none)) {
      case Owed::pause:
        return line.need("PAUSE");
      case Owed::jump:
        return line.need("IF (R[90]>.01 OR R[90]<(-.01)),JMP LBL[999]");
      case Owed::abort:
        line.need("ABORT");
        aborts_ = true;
        return;
      case Owed::none:
        break;
    }
    if (line.take("LBL[999]")) {
      owed_ = Owed::abort;
    } else if (line.take("!VOXELS CUT ")) {
      take_voxels(line, part_);
    } else if (line.take("!")) {
      if (!line.rest().starts_with("MOUNT")) return;
      part_.tool = mounted(line, part_);
      owed_ = Owed::pause;
    } else if (line.take("J P[")) {
      take_move(line);
    } else if (line.take("R[90]=PR[90,")) {
      line.number();
      line.need("]-(");
      take_start(line, part_, line.number());
      owed_ = Owed::jump;
    }
  }

  void take_move(ProgramLine& line) {
    const int wanted = static_cast<int>(line.number());
    line.need("]");
    moves_.emplace_back(wanted, line.number() / 1000);
    line.need("msec FINE");
    line.need(";");
  }

  std::size_t axes_;
  ReadPart part_;
  std::vector<std::pair<int, double>> moves_;  // position, seconds
  std::map<int, std::vector<double>> positions_;
  int open_ = 0, lines_ = 0;  // the position whose axes are read, the last line's number
  bool ended_ = false, aborts_ = false;
  Owed owed_ = Owed::none;
};

}  // namespace

ReadPart read_fanuc(std::string_view text, std::size_t axes) {
  FanucLines part(axes);
  for_lines(text, true, [&](ProgramLine& line) { part.take(line); });
  return part.finish();
}

}  // namespace sculpt
