// Universal Robots URScript: movej with a time and no blend.
#include "core/program/write/number_format.hpp"
#include "core/program/write/part_writer.hpp"

namespace sculpt {
namespace {

constexpr int ur_decimals = 7, ur_time_decimals = 4;

class UrPart : public PartWriter {
 public:
  UrPart(const AxisLayout& layout, const ProgramNames& names, const Configuration& start)
      : layout_(layout), names_(names) {
    text_ = "def " + names.part_name() + "():\n  # part " + std::to_string(names.part) + " of " +
            std::to_string(names.parts) + "; angles in rad; every move ends at rest\n  # " +
            names.voxels.text_before() + "\n  # " + names.voxels.text_after() + "\n";
    if (names.mount) text_ += "  popup(\"" + names.mount->text() + "\", title=\"sculpt\", blocking=True)\n";
    text_ += "  # it must begin where it begins, within 0.01 degree\n  local here = get_actual_joint_positions()\n";
    for (std::size_t at = 0; at < 6; ++at) {
      text_ += "  if norm(here[" + std::to_string(at) + "] - (";
      append_fixed(text_, start[static_cast<Eigen::Index>(at)], ur_decimals);
      text_ +=
          ")) > 0.00018:\n    popup(\"not where this part begins\", title=\"sculpt\", error=True, blocking=True)\n    "
          "halt\n  end\n";
    }
  }

  void add(const ProgramMove& move) override {
    text_ += "  movej([";
    for (std::size_t at = 0; at < 6; ++at) {
      if (at > 0) text_ += ", ";
      append_fixed(text_, move.axes[static_cast<Eigen::Index>(at)], ur_decimals);
    }
    text_ += "], t=";
    append_fixed(text_, move.seconds + 0.00005, ur_time_decimals);
    text_ += ")\n";
  }

  std::uint64_t bytes() const override { return text_.size(); }

  std::vector<ProgramFile> finish() override {
    return {{names_.part_name() + ".script", text_ + "end\n" + names_.part_name() + "()\n"}};
  }

 private:
  const AxisLayout& layout_;
  const ProgramNames names_;
  std::string text_;
};

}  // namespace

std::unique_ptr<PartWriter> urscript_part(const AxisLayout& layout, const ProgramNames& names,
                                          const Configuration& start) {
  return std::make_unique<UrPart>(layout, names, start);
}

}  // namespace sculpt
