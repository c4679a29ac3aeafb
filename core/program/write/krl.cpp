// KUKA KRL: PTP to axis values, each with an exact stop.
#include <cmath>

#include "core/base/error.hpp"
#include "core/program/write/number_format.hpp"
#include "core/program/write/part_writer.hpp"

namespace sculpt {
namespace {

constexpr int krl_decimals = 5;
// $VEL_AXIS and $OV_PRO are whole percent: together they say a speed in steps of a tenth of a percent and less.
constexpr int slow_override = 10, min_override = 1;

class KrlPart : public PartWriter {
 public:
  KrlPart(const AxisLayout& layout, const ProgramNames& names, const Configuration& start)
      : layout_(layout), names_(names) {
    const std::string name = names.part_name();
    text_ = "&ACCESS RVP\r\n&REL 1\r\nDEF " + name + "()\r\n; part " + std::to_string(names.part) + " of " +
            std::to_string(names.parts) + "; angles in degrees, lengths in mm; every PTP ends with an exact stop\r\n" +
            "; " + names.voxels.text_before() + "\r\n; " + names.voxels.text_after() +
            "\r\nINT I\r\nBAS(#INITMOV,0)\r\n";
    if (names.mount) text_ += "; " + names.mount->text() + "\r\nHALT\r\n";
    text_ += "$ADVANCE=1\r\nFOR I=1 TO 6\r\n  $ACC_AXIS[I]=100\r\nENDFOR\r\n";
    text_ += "; it must begin where it begins, within 0.01 degree or mm\r\n";
    for (std::size_t at = 0; at < layout.axes.size(); ++at) {
      text_ += "IF ABS($AXIS_ACT." + axis_name(at) + "-(";
      append_fixed(text_, in_degrees_or_mm(layout.axes[at], start[static_cast<Eigen::Index>(at)]), krl_decimals);
      text_ += "))>0.01 THEN\r\n  HALT\r\nENDIF\r\n";
    }
  }

  void add(const ProgramMove& move) override {
    set_speed(move.share);
    text_ += "PTP {";
    for (std::size_t at = 0; at < layout_.axes.size(); ++at) {
      text_ += (at == 0 ? "" : ",") + axis_name(at) + " ";
      append_fixed(text_, in_degrees_or_mm(layout_.axes[at], move.axes[static_cast<Eigen::Index>(at)]), krl_decimals);
    }
    text_ += "}\r\n";
  }

  std::uint64_t bytes() const override { return text_.size(); }

  std::vector<ProgramFile> finish() override {
    const std::string name = names_.part_name();
    return {{name + ".src", text_ + "END\r\n"},
            {name + ".dat", "&ACCESS RVP\r\n&REL 1\r\nDEFDAT " + name + "\r\nENDDAT\r\n"}};
  }

 private:
  std::string axis_name(std::size_t at) const {
    return at < layout_.robot_axes ? "A" + std::to_string(at + 1) : "E" + std::to_string(at + 1 - layout_.robot_axes);
  }

  void set_speed(double share) {
    int override_percent = 100, percent = static_cast<int>(std::floor(100 * share));
    if (percent < slow_override) {
      override_percent = slow_override;
      percent = static_cast<int>(std::floor(1000 * share));
    }
    if (percent < slow_override) {
      override_percent = min_override;
      percent = static_cast<int>(std::floor(10000 * share));
    }
    percent = std::min(percent, 100);
    if (percent < 1)
      throw InputError("speed_too_coarse",
                       "KRL says speeds in steps of 0.01 % of an axis's largest, and a move needs less: "
                       "ask for a higher --feed");
    if (override_percent != override_) text_ += "$OV_PRO=" + std::to_string(override_percent) + "\r\n";
    override_ = override_percent;
    if (percent == percent_) return;
    percent_ = percent;
    text_ += "FOR I=1 TO 6\r\n  $VEL_AXIS[I]=" + std::to_string(percent) + "\r\nENDFOR\r\n";
    for (std::size_t at = layout_.robot_axes; at < layout_.axes.size(); ++at)
      text_ += "$VEL_EXTAX[" + std::to_string(at + 1 - layout_.robot_axes) + "]=" + std::to_string(percent) + "\r\n";
  }

  const AxisLayout& layout_;
  const ProgramNames names_;
  std::string text_;
  int override_ = 0, percent_ = 0;
};

}  // namespace

std::unique_ptr<PartWriter> krl_part(const AxisLayout& layout, const ProgramNames& names, const Configuration& start) {
  return std::make_unique<KrlPart>(layout, names, start);
}

}  // namespace sculpt
