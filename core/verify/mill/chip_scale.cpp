#include "core/verify/mill/chip_scale.hpp"

#include <cmath>
#include <sstream>

namespace sculpt {
namespace {

constexpr double slack = 1.1, layers = 2;

}  // namespace

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
  const double layer = diameter * depth * voxel_mm;  // of voxels, across the cut
  if (length_ < diameter || volume_ <= slack * depth * width * length_ + layers * layer) return {};
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
