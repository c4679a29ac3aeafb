// LinuxCNC G-code: G93, a time for every block, exact path.
#include "core/program/write/number_format.hpp"
#include "core/program/write/part_writer.hpp"

namespace sculpt {
namespace {

constexpr int mm_decimals = 4, degree_decimals = 6, feed_decimals = 5;

class GcodePart : public PartWriter {
 public:
  GcodePart(const AxisLayout& layout, const ProgramNames& names, const Configuration& start)
      : layout_(layout), names_(names) {
    const std::string name = names.part_name();
    text_ = "; part " + std::to_string(names.part) + " of " + std::to_string(names.parts) +
            "; mm and degrees; joint by joint, so trivial kinematics\n; " + names.voxels.text_before() + "\n; " +
            names.voxels.text_after() + "\no<" + name + "> sub\nG21 G90 G61 G40 G49 G80\n";
    if (names.mount) text_ += "T" + std::to_string(names.mount->number) + " M6 ; " + names.mount->text() + "\n";
    text_ += "G93\n; it must begin where it begins, within 0.01\n";
    for (std::size_t at = 0; at < layout.axes.size(); ++at) {
      // What is written is where the machine stands in its own coordinates, without offsets.
      const std::size_t parameter = 5420 + std::string("XYZABCUVW").find(layout.axes[at].name[0]);
      text_ += "o" + std::to_string(100 + at) + " if [ABS[#" + std::to_string(parameter) + " - [";
      append_value(at, start[static_cast<Eigen::Index>(at)]);
      text_ += "]] GT 0.01]\n  (ABORT, not where this part begins)\no" + std::to_string(100 + at) + " endif\n";
    }
  }

  void add(const ProgramMove& move) override {
    text_ += "G1";
    for (std::size_t at = 0; at < layout_.axes.size(); ++at) {
      text_ += ' ' + layout_.axes[at].name;
      append_value(at, move.axes[static_cast<Eigen::Index>(at)]);
    }
    text_ += " F";
    append_fixed(text_, 60 / move.seconds - 0.000005, feed_decimals);  // moves a minute, rounded down
    text_ += '\n';
  }

  std::uint64_t bytes() const override { return text_.size(); }

  std::vector<ProgramFile> finish() override {
    const std::string name = names_.part_name();
    return {{name + ".ngc", text_ + "G94\no<" + name + "> endsub\nM2\n"}};
  }

 private:
  void append_value(std::size_t at, double value) {
    append_fixed(text_, in_degrees_or_mm(layout_.axes[at], value),
                 layout_.axes[at].turns ? degree_decimals : mm_decimals);
  }

  const AxisLayout& layout_;
  const ProgramNames names_;
  std::string text_;
};

}  // namespace

std::unique_ptr<PartWriter> gcode_part(const AxisLayout& layout, const ProgramNames& names,
                                       const Configuration& start) {
  return std::make_unique<GcodePart>(layout, names, start);
}

}  // namespace sculpt
