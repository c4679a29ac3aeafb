// FANUC LS (ASCII teach pendant program): J moves by time with FINE, positions as joints.
#include <cmath>

#include "core/program/write/number_format.hpp"
#include "core/program/write/part_writer.hpp"

namespace sculpt {
namespace {

const int fanuc_decimals = facts_of(Dialect::fanuc).decimals;

class FanucPart : public PartWriter {
 public:
  FanucPart(const AxisLayout& layout, const ProgramNames& names, const Configuration& start)
      : layout_(layout), names_(names) {
    add_line("  !PART " + std::to_string(names.part) + " OF " + std::to_string(names.parts));
    add_line("  !" + names.voxels.text_before());
    add_line("  !" + names.voxels.text_after());
    if (names.mount) {
      add_line("  !" + names.mount->text());
      add_line("  PAUSE");
    }
    add_line("  !IT MUST BEGIN WHERE IT BEGINS");
    add_line("  PR[90]=JPOS   ");
    for (std::size_t at = 0; at < layout.axes.size(); ++at) {
      std::string difference = "  R[90]=PR[90," + std::to_string(at + 1) + "]-(";
      append_fixed(difference, in_degrees_or_mm(layout.axes[at], start[static_cast<Eigen::Index>(at)]), fanuc_decimals);
      add_line(difference + ")   ");
      add_line("  IF (R[90]>.01 OR R[90]<(-.01)),JMP LBL[999]");
    }
  }

  void add(const ProgramMove& move) override {
    add_position(move.axes);
    const auto milliseconds = static_cast<long long>(std::ceil(1000 * move.seconds - 1e-9));
    add_line("J P[" + std::to_string(positions_) + "] " + std::to_string(std::max(1ll, milliseconds)) + "msec FINE   ");
  }

  std::uint64_t bytes() const override { return text_.size() + positions_text_.size(); }

  std::vector<ProgramFile> finish() override {
    add_line("  END");
    add_line("  LBL[999]");
    add_line("  ABORT");
    const std::string name = names_.part_name();
    return {{name + ".ls",
             "/PROG  " + name + "\r\n/ATTR\r\nCOMMENT = \"sculpt\";\r\nLINE_COUNT = " + std::to_string(lines_) +
                 ";\r\nDEFAULT_GROUP = 1,*,*,*,*;\r\n/MN\r\n" + text_ + "/POS\r\n" + positions_text_ + "/END\r\n"}};
  }

 private:
  void add_line(const std::string& words) {
    const std::string number = std::to_string(++lines_);
    text_ += std::string(number.size() < 4 ? 4 - number.size() : 0, ' ') + number + ":" + words + " ;\r\n";
  }

  void add_position(const Configuration& axes) {
    positions_text_ += "P[" + std::to_string(++positions_) + "]{\r\n   GP1:\r\n\tUF : 0, UT : 1,\t\r\n";
    for (std::size_t at = 0; at < layout_.axes.size(); ++at) {
      const bool robot = at < layout_.robot_axes;
      positions_text_ += (at % 3 == 0 ? "\t" : "") + std::string(robot ? "J" : "E") +
                         std::to_string(robot ? at + 1 : at + 1 - layout_.robot_axes) + "= ";
      append_fixed(positions_text_, in_degrees_or_mm(layout_.axes[at], axes[static_cast<Eigen::Index>(at)]),
                   fanuc_decimals);
      positions_text_ += layout_.axes[at].turns ? " deg" : "  mm";
      if (at + 1 < layout_.axes.size()) positions_text_ += at % 3 == 2 ? ",\r\n" : ",\t";
    }
    positions_text_ += "\r\n};\r\n";
  }

  const AxisLayout& layout_;
  const ProgramNames names_;
  std::string text_, positions_text_;
  std::size_t positions_ = 0, lines_ = 0;
};

}  // namespace

std::unique_ptr<PartWriter> fanuc_part(const AxisLayout& layout, const ProgramNames& names,
                                       const Configuration& start) {
  return std::make_unique<FanucPart>(layout, names, start);
}

}  // namespace sculpt
