// ABB RAPID: MoveAbsJ with a time and a fine point.
#include "core/program/write/number_format.hpp"
#include "core/program/write/part_writer.hpp"

namespace sculpt {
namespace {

constexpr int rapid_decimals = 5, rapid_time_decimals = 3;

class RapidPart : public PartWriter {
 public:
  RapidPart(const AxisLayout& layout, const ProgramNames& names, const Configuration& start)
      : layout_(layout), names_(names) {
    const std::string name = names.part_name();
    text_ = "MODULE " + name + "\r\n  ! part " + std::to_string(names.part) + " of " + std::to_string(names.parts) +
            "; angles in degrees, lengths in mm; every move ends in a fine point\r\n  ! " + names.voxels.text_before() +
            "\r\n  ! " + names.voxels.text_after() + "\r\n  PROC " + name + "_run()\r\n    VAR jointtarget here;\r\n";
    if (names.mount) text_ += "    TPWrite \"" + names.mount->text() + "\";\r\n    Stop;\r\n";
    text_ += "    here:=CJointT();\r\n    ! it must begin where it begins, within 0.01 degree or mm\r\n";
    for (std::size_t at = 0; at < layout.axes.size(); ++at) {
      const bool robot = at < layout.robot_axes;
      text_ += std::string("    IF Abs(here.") +
               (robot ? "robax.rax_" + std::to_string(at + 1)
                      : std::string("extax.eax_") + static_cast<char>('a' + at - layout.robot_axes)) +
               "-(";
      append_fixed(text_, in_degrees_or_mm(layout.axes[at], start[static_cast<Eigen::Index>(at)]), rapid_decimals);
      text_ += "))>0.01 THEN\r\n      Stop;\r\n    ENDIF\r\n";
    }
  }

  void add(const ProgramMove& move) override {
    text_ += "    MoveAbsJ [[";
    for (std::size_t at = 0; at < 6; ++at) {
      if (at > 0) text_ += ',';
      append_fixed(text_, in_degrees_or_mm(layout_.axes[at], move.axes[static_cast<Eigen::Index>(at)]), rapid_decimals);
    }
    text_ += "],[";
    for (std::size_t external = 0; external < 6; ++external) {
      if (external > 0) text_ += ',';
      const std::size_t at = layout_.robot_axes + external;
      if (at < layout_.axes.size())
        append_fixed(text_, in_degrees_or_mm(layout_.axes[at], move.axes[static_cast<Eigen::Index>(at)]),
                     rapid_decimals);
      else
        text_ += "9E9";
    }
    text_ += "]]\\NoEOffs,v1000\\T:=";
    append_fixed(text_, move.seconds + 0.0005, rapid_time_decimals);  // rounded up
    text_ += ",fine,tool0;\r\n";
  }

  std::uint64_t bytes() const override { return text_.size(); }

  std::vector<ProgramFile> finish() override {
    return {{names_.part_name() + ".mod", text_ + "  ENDPROC\r\nENDMODULE\r\n"}};
  }

 private:
  const AxisLayout& layout_;
  const ProgramNames names_;
  std::string text_;
};

}  // namespace

std::unique_ptr<PartWriter> rapid_part(const AxisLayout& layout, const ProgramNames& names,
                                       const Configuration& start) {
  return std::make_unique<RapidPart>(layout, names, start);
}

}  // namespace sculpt
