#include "core/mill/finish/nails.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

constexpr double never_met = std::numeric_limits<double>::infinity();
constexpr double nails_a_box = 6;
/// The real root of x^3 = x + 1.
constexpr double plastic = 1.32471795724474602596;
/// How far from the surface it is found out what is inside (voxel edges).
constexpr double look_voxels = 1.0;
/// Surface that looks straight down, nearly, from so little above the bottom of the block is what the part stands on.
constexpr double base_cosine = 0.9, base_m = 1e-3;

double signed_volume(const Mesh& part) {
  double volume = 0;
  for (const auto& t : part.triangles)
    volume += part.vertices[t[0]].dot(part.vertices[t[1]].cross(part.vertices[t[2]])) / 6;
  return volume;
}

bool is_kept(const VoxelGrid& voxels, const Grid& grid, const Vec3& point) {
  const Vec3 at = (point - grid.origin_m) / grid.voxel_m;
  if ((at.array() < 0).any() || (at.array() >= grid.n).any()) return false;
  return voxels.keep.contains({static_cast<int>(at.x()), static_cast<int>(at.y()), static_cast<int>(at.z())});
}

/// The normal outwards; none where both sides are inside.
std::optional<Vec3> outward(const Vec3& point, const Vec3& normal, const VoxelGrid& voxels, const Grid& grid) {
  const double off = look_voxels * grid.voxel_m;
  const bool before = is_kept(voxels, grid, point + off * normal), behind = is_kept(voxels, grid, point - off * normal);
  if (before && behind && is_kept(voxels, grid, point + 2 * off * normal) &&
      is_kept(voxels, grid, point - 2 * off * normal))
    return std::nullopt;
  return before && !behind ? Vec3(-normal) : normal;
}

/// Does the part stand on it?
bool is_base(const Vec3& point, const Vec3& normal, const Grid& grid) {
  return std::abs(normal.z()) > base_cosine && point.z() < grid.origin_m.z() + base_m;
}

/// From a point along a direction to the side of the block.
double way_out(const Grid& grid, const Vec3& point, const Vec3& direction) {
  double way = never_met;
  for (int axis = 0; axis < 3; ++axis) {
    const double side = grid.origin_m[axis] + (direction[axis] > 0 ? grid.n * grid.voxel_m : 0);
    if (direction[axis] != 0) way = std::min(way, (side - point[axis]) / direction[axis]);
  }
  return std::max(0.0, way);
}

/// Of the facets up to each.
std::vector<double> running_areas(const Mesh& part) {
  std::vector<double> areas;
  areas.reserve(part.triangles.size());
  double area = 0;
  for (const auto& t : part.triangles) {
    area += (part.vertices[t[1]] - part.vertices[t[0]]).cross(part.vertices[t[2]] - part.vertices[t[0]]).norm() / 2;
    areas.push_back(area);
  }
  return areas;
}

/// One in each of `count` shares of the area, where it belongs to the surface. Over a facet they are spread evenly, for
/// a spot between nails that is left would not be known of (R2, the sequence of the plastic number; Roberts, "The
/// unreasonable effectiveness of quasirandom sequences", 2018).
std::vector<Nail> drive_nails(const Mesh& part, const std::vector<double>& areas, const VoxelGrid& voxels,
                              const Grid& grid, std::size_t count, std::uint64_t seed) {
  const double turn = signed_volume(part) < 0 ? -1 : 1;
  Random random(seed);
  double x_share = random.unit(), y_share = random.unit();
  const auto step = [](double& share, double by) { share += by - std::floor(share + by); };
  std::vector<Nail> nails;
  std::size_t facet = 0;
  for (std::size_t share = 0; share < count; ++share) {
    const double at = (static_cast<double>(share) + random.unit()) * areas.back() / static_cast<double>(count);
    while (facet + 1 < areas.size() && areas[facet] < at) ++facet;
    const auto& t = part.triangles[facet];
    const Vec3 e = part.vertices[t[1]] - part.vertices[t[0]], f = part.vertices[t[2]] - part.vertices[t[0]];
    step(x_share, 1 / plastic);
    step(y_share, 1 / (plastic * plastic));
    const bool is_beyond = x_share + y_share > 1;
    const double x = is_beyond ? 1 - x_share : x_share, y = is_beyond ? 1 - y_share : y_share;
    const Vec3 point = part.vertices[t[0]] + x * e + y * f, normal = turn * e.cross(f).normalized();
    if (is_base(point, normal, grid)) continue;
    if (const auto out = outward(point, normal, voxels, grid)) nails.push_back({point, *out});
  }
  return nails;
}

/// From a point along a direction to where a ball went on its middle's way between the two ends: the cylinder about
/// that.
double way_to_cylinder(const Nail& nail, const Vec3& from, const Vec3& way, double radius) {
  const double length2 = way.squaredNorm();
  if (!(length2 > 0)) return never_met;
  const Vec3 off = nail.point - from;
  const Vec3 p = off - way * (off.dot(way) / length2), d = nail.normal - way * (nail.normal.dot(way) / length2);
  const double a = d.squaredNorm(), b = p.dot(d), c = p.squaredNorm() - radius * radius, root = b * b - a * c;
  if (!(a > 1e-12 && root >= 0) || (-b + std::sqrt(root)) / a < 0) return never_met;
  const double t = (-b - std::sqrt(root)) / a, along = (off + t * nail.normal).dot(way);
  return along >= 0 && along <= length2 ? t : never_met;
}

}  // namespace

double way_to_ball(const Vec3& point, const Vec3& direction, const Vec3& middle, double radius) {
  const Vec3 to = middle - point;
  const double along = to.dot(direction), left = along * along - to.squaredNorm() + radius * radius;
  if (left < 0) return never_met;
  const double root = std::sqrt(left);
  return along + root < 0 ? never_met : along - root;
}

Nails::Nails(const Mesh& part, const VoxelGrid& voxels, const Grid& grid, std::size_t count, std::uint64_t seed) {
  const std::vector<double> areas = running_areas(part);
  if (areas.empty() || !(areas.back() > 0)) return;
  area_m2_ = areas.back() / static_cast<double>(count);
  sort_into_boxes(drive_nails(part, areas, voxels, grid, count, seed));
  excess_.assign(nails_.size(), static_cast<float>(uncut));
  reachable_.resize(nails_.size());
  for (std::size_t at = 0; at < nails_.size(); ++at)
    if (const double way = way_out(grid, nails_[at].point, nails_[at].normal); way < farthest_m)
      excess_[at] = static_cast<float>(way);
}

void Nails::sort_into_boxes(const std::vector<Nail>& nails) {
  if (nails.empty()) return;
  Eigen::AlignedBox3d all;
  for (const Nail& nail : nails) all.extend(nail.point);
  low_ = all.min();
  edge_ = std::max(std::sqrt(nails_a_box * area_m2_), all.sizes().maxCoeff() / 500);
  std::size_t boxes = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    boxes_[axis] = static_cast<int>(all.sizes()[static_cast<int>(axis)] / edge_) + 1;
    boxes *= static_cast<std::size_t>(boxes_[axis]);
  }
  const auto box_of = [&](const Nail& nail) {
    const Vec3 at = (nail.point - low_) / edge_;
    return boxes_row(static_cast<int>(at.y()), static_cast<int>(at.z())) + static_cast<std::size_t>(at.x());
  };
  begin_.assign(boxes + 1, 0);
  for (const Nail& nail : nails) ++begin_[box_of(nail) + 1];
  for (std::size_t box = 0; box < boxes; ++box) begin_[box + 1] += begin_[box];
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  nails_.resize(nails.size());
  for (const Nail& nail : nails) nails_[next[box_of(nail)]++] = nail;
}

/// What a ball on its way leaves above a nail; nothing where it does not come near.
std::optional<double> Nails::excess_under(const Nail& nail, const Vec3& from, const Vec3& to, double radius,
                                          double most_m) {
  const Vec3 way = to - from, off = nail.point - from;
  const double length2 = way.squaredNorm(), reach = radius + most_m;
  const double share = length2 > 0 ? std::clamp(off.dot(way) / length2, 0.0, 1.0) : 0;
  if ((off - share * way).squaredNorm() > reach * reach) return std::nullopt;
  const double least =
      std::min({way_to_ball(nail.point, nail.normal, from, radius), way_to_ball(nail.point, nail.normal, to, radius),
                way_to_cylinder(nail, from, way, radius)});
  // A ball that is behind the surface, or comes to it from there, cuts something else.
  const double behind = -1e-5;
  return least < behind ? std::nullopt : std::optional(std::max(0.0, least));
}

void Nails::cut(const Vec3& from, const Vec3& to, double radius) {
  const auto is_above = [&](std::uint32_t at) { return excess_[at] > 0; };
  for_each_cut(from, to, radius, farthest_m, is_above,
               [&](std::uint32_t at, double left) { excess_[at] = std::min(excess_[at], static_cast<float>(left)); });
}

}  // namespace sculpt
