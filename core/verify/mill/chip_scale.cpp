#include "core/verify/mill/chip_scale.hpp"

#include <cmath>
#include <sstream>

#include "core/verify/findings/slack.hpp"

namespace sculpt {
std::string ChipScale::weigh(const MillTool& tool, std::uint64_t voxels, double voxel_mm, double length) {
  const double diameter = 2000 * tool.cutter.radius_m, depth = 1000 * tool.max_depth_m, width = 1000 * tool.max_width_m;
  chips_.emplace_back(static_cast<double>(voxels) * std::pow(voxel_mm, 3), length);
  volume_ += chips_.back().first;
  length_ += length;
  while (chips_.size() > 1 && length_ - chips_.front().second >= diameter) {
    volume_ -= chips_.front().first;
    length_ -= chips_.front().second;
    chips_.pop_front();
  }
  // A box holds the centres of no more voxels than (side / voxel + 1), along each side.
  const double chip = chip_slack * depth * width + voxel_mm * (depth + width + voxel_mm);
  if (length_ < diameter || volume_ <= chip * (length_ + voxel_mm)) return {};
  std::ostringstream text;
  text << "over the last " << length_ << " mm the cutter takes off " << volume_ / length_ << " mm2, more than " << depth
       << " x " << width << " mm";
  return text.str();
}

void ChipScale::end() {
  chips_.clear();
  volume_ = length_ = 0;
}

}  // namespace sculpt
