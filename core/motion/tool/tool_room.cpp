#include "core/motion/tool/tool_room.hpp"

#include <algorithm>

#include "core/collision/clearance.hpp"
#include "core/collision/margins.hpp"

namespace sculpt {
namespace {

/// What of the tool's link is round about the tool's axis: its holder, wherever the joints turn it.
std::vector<Body> find_holder(const Chain& chain) {
  std::vector<Body> holder;
  for (const Shape& shape : chain.robot().links[static_cast<std::size_t>(chain.tool_link())].shapes) {
    if (shape.kind != ShapeKind::cylinder || !shape.pose.linear().isIdentity() ||
        !shape.pose.translation().head<2>().isZero())
      continue;
    holder.push_back({chain.tool_link(), true, {{std::make_shared<const ShapeTree>(make_tree(shape)), 0}}});
  }
  return holder;
}

}  // namespace

ToolRoom::ToolRoom(const Scene& scene)
    : grid_(scene.grid()), tool_(scene.tool()), holder_(find_holder(scene.chain())) {}

bool ToolRoom::is_free(const Material& material, Voxel voxel, const Vec3& axis) const {
  const double h = grid_.voxel_m;
  const Vec3 ball = grid_.centre(voxel), top = ball + tool_.stickout_m * axis;
  const double radius = std::max(tool_.ball_radius_m, tool_.shank_radius_m) / h + tool_margin_voxels;
  if (material.meets_capsule({(ball - grid_.origin_m) / h, (top - grid_.origin_m) / h}, radius, voxel)) return false;
  Frame link = Frame::Identity();
  link.translation() = top;
  link.linear() = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), -axis).toRotationMatrix();
  return std::none_of(holder_.begin(), holder_.end(), [&](const Body& section) {
    return near_material(section, link, material, grid_, link_margin_m);
  });
}

}  // namespace sculpt
