#include "core/solid/placement.hpp"

#include <limits>
#include <sstream>

#include "core/base/error.hpp"

namespace sculpt {
namespace {

struct Bounds {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  Vec3 size() const { return high - low; }
};

Bounds bounds_of(const Mesh& mesh) {
  Bounds bounds;
  for (const auto& triangle : mesh.triangles) {
    for (std::uint32_t id : triangle) {
      bounds.low = bounds.low.cwiseMin(mesh.vertices[id]);
      bounds.high = bounds.high.cwiseMax(mesh.vertices[id]);
    }
  }
  return bounds;
}

template <typename... Parts>
std::string sentence(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

void check(const Placement& placement, double edge_m) {
  if (placement.scale_m && !(*placement.scale_m > 0 && std::isfinite(*placement.scale_m)))
    throw InputError("placement_invalid",
                     sentence("scale_m ", *placement.scale_m,
                              " makes no sense: give a positive number of metres per mesh unit, or "
                              "leave it out to make the mesh fit"));
  if (!(placement.margin_m >= 0 && 2 * placement.margin_m < edge_m))
    throw InputError("placement_invalid",
                     sentence("margin_m ", placement.margin_m, " leaves no room: give a margin from 0 to less than ",
                              edge_m / 2, " m, half the edge of the stock"));
  if (!placement.rotation_rad.allFinite() || !placement.offset_m.allFinite())
    throw InputError("placement_invalid", "rotation_rad and offset_m must be finite numbers: leave them out for none");
}

double fitting_scale(const Vec3& size, double edge_m, double margin_m) {
  const Vec3 room(edge_m - 2 * margin_m, edge_m - 2 * margin_m, edge_m - margin_m);
  double scale = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    if (size[axis] > 0) scale = std::min(scale, room[axis] / size[axis]);
  return scale;
}

void check_inside(const Bounds& bounds, const Placement& placement, const Grid& grid) {
  const double edge_m = grid.n * grid.voxel_m;
  const double tolerance_m = 1e-6 * grid.voxel_m;  // rounding of the fit itself
  for (int axis = 0; axis < 3; ++axis) {
    const double below_m = grid.origin_m[axis] - bounds.low[axis];
    const double above_m = bounds.high[axis] - grid.origin_m[axis] - edge_m;
    const double out_m = std::max(below_m, above_m);
    if (out_m <= tolerance_m) continue;
    const bool too_large = bounds.size()[axis] > edge_m + tolerance_m;
    const char* cure = !too_large          ? "change offset_m"
                       : placement.scale_m ? "lower scale_m, or leave it out to make the mesh fit"
                                           : "change offset_m or rotation_rad";
    throw InputError("target_outside_stock",
                     sentence("the placed mesh is outside the stock by ", out_m, " m at the ",
                              below_m > above_m ? "low" : "high", " end of ", "xyz"[axis], ": ", cure));
  }
}

}  // namespace

Mesh place_mesh(const Mesh& mesh, const Placement& placement, const Grid& grid) {
  const double edge_m = grid.n * grid.voxel_m;
  check(placement, edge_m);
  Mesh placed = mesh;
  const Eigen::Matrix3d rotation = (Eigen::AngleAxisd(placement.rotation_rad.z(), Vec3::UnitZ()) *
                                    Eigen::AngleAxisd(placement.rotation_rad.y(), Vec3::UnitY()) *
                                    Eigen::AngleAxisd(placement.rotation_rad.x(), Vec3::UnitX()))
                                       .toRotationMatrix();
  if (!placement.rotation_rad.isZero(0))
    for (Vec3& vertex : placed.vertices) vertex = rotation * vertex;

  const Bounds before = bounds_of(placed);
  const double scale = placement.scale_m.value_or(fitting_scale(before.size(), edge_m, placement.margin_m));
  const Vec3 foot((before.low.x() + before.high.x()) / 2, (before.low.y() + before.high.y()) / 2, before.low.z());
  const Vec3 target = grid.origin_m + Vec3(edge_m / 2, edge_m / 2, 0) + placement.offset_m;
  for (Vec3& vertex : placed.vertices) vertex = (vertex - foot) * scale + target;
  check_inside(bounds_of(placed), placement, grid);
  return placed;
}

}  // namespace sculpt
