#include "core/verify/mill/machined_surface.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

#include "core/mesh/refine.hpp"
#include "core/trajectory/reader.hpp"
#include "core/verify/mill/cutter_sweep.hpp"
#include "core/verify/mill/surface_points.hpp"

namespace sculpt {
namespace {

/// Of the block: a finer mesh would only be a longer file.
constexpr double edges_along = 256;
constexpr std::size_t enough_triangles = 2'000'000;
/// Vertices whose triangles face each other have no side of their own.
constexpr double least_normal = 1e-6;

/// As far as the smallest ball leaves something in an upright corner (mm), within reason.
double near_of(const std::vector<MillTool>& tools) {
  constexpr double least = 1, most = 5, more = 1.1;
  double radius_m = std::numeric_limits<double>::infinity();
  for (const MillTool& tool : tools)
    if (tool.cutter.kind == CutterKind::ball) radius_m = std::min(radius_m, tool.cutter.radius_m);
  return std::clamp(1000 * more * radius_m, least, most);
}

/// Outward where triangles turn about it as they should (unit vectors); nothing where it has no side, or lies inside.
std::vector<std::optional<Vec3>> normals_of(const Mesh& mesh, const VoxelGrid& voxels, const Grid& grid) {
  std::vector<Vec3> sums(mesh.vertices.size(), Vec3::Zero());
  std::vector<double> areas(mesh.vertices.size(), 0);
  double volume = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const Vec3 across = (b - a).cross(c - a);
    volume += a.dot(b.cross(c));
    for (const std::uint32_t vertex : t) {
      sums[vertex] += across;
      areas[vertex] += across.norm();
    }
  }
  std::vector<std::optional<Vec3>> normals(mesh.vertices.size());
  for (std::size_t vertex = 0; vertex < normals.size(); ++vertex) {
    const double length = sums[vertex].norm();
    if (!(length > least_normal * areas[vertex])) continue;
    const Vec3 normal = sums[vertex] / (volume < 0 ? -length : length);
    normals[vertex] = outward(1000 * mesh.vertices[vertex], normal, voxels, grid);
  }
  return normals;
}

/// Those vertices that have a normal, and the triangles between them.
MachinedSurface keep_sided(const Mesh& mesh, const std::vector<std::optional<Vec3>>& normals,
                           std::vector<SurfacePoint>& points) {
  MachinedSurface surface;
  std::vector<std::uint32_t> numbers(mesh.vertices.size());
  for (std::size_t vertex = 0; vertex < numbers.size(); ++vertex) {
    if (!normals[vertex]) continue;
    numbers[vertex] = static_cast<std::uint32_t>(points.size());
    points.push_back({1000 * mesh.vertices[vertex], *normals[vertex]});
    surface.mesh.vertices.push_back(mesh.vertices[vertex]);
  }
  for (const auto& t : mesh.triangles)
    if (std::ranges::all_of(t, [&](std::uint32_t vertex) { return normals[vertex].has_value(); }))
      surface.mesh.triangles.push_back({numbers[t[0]], numbers[t[1]], numbers[t[2]]});
  return surface;
}

/// Carries out a plan: cuts the points, and takes the cubes that are gone as a whole from `standing`.
void carry_out(TrajectoryReader& reader, SurfacePoints& points, VoxelSet& standing, std::uint64_t keep,
               const Grid& grid, const Watch& watch) {
  const MillHeader& mill = *reader.header().mill;
  const double more = std::numbers::sqrt3 / 2 * grid.voxel_m, stray_mm = 1000 * mill.stray_m;
  const auto in_mm = [](const MillStep& step) -> Vec3 {
    return Vec3(static_cast<double>(step.tip[0]), static_cast<double>(step.tip[1]), static_cast<double>(step.tip[2])) *
           1e-4;
  };
  const MillTool* tool = &mill.tools.front();
  std::map<int, CutterSweep> cubes;
  std::optional<MillStep> before;
  const std::uint64_t to_remove = standing.size() - keep;
  std::uint64_t removed = 0;
  while (const auto keyframe = reader.next()) {
    const MillStep& step = *keyframe->mill;
    if (step.is_change()) {
      tool = &mill.tools[static_cast<std::size_t>(step.tool)];
      cubes.clear();
    }
    if (keyframe->cut && before && before->direction == step.direction) {
      const auto& way = mill.directions[static_cast<std::size_t>(step.direction)];
      cubes.try_emplace(step.direction, tool->cutter, way, mill.stray_m + more)
          .first->second.take(standing, grid, before->tip, step.tip);
      const double radius = 1000 * tool->cutter.radius_m;
      const Vec3 up = radius * Vec3(way[0], way[1], way[2]).normalized();
      if (tool->cutter.kind == CutterKind::ball) points.cut(in_mm(*before) + up, in_mm(step) + up, radius, stray_mm);
    }
    before = step.is_placed() ? std::optional(step) : std::nullopt;
    removed += step.removed;
    watch.step(Stage::write, std::min(removed, to_remove), to_remove);
  }
}

}  // namespace

MachinedSurface machined_surface(std::istream& plan, Mesh part, const VoxelGrid& voxels, const Grid& grid,
                                 const Watch& watch) {
  TrajectoryReader reader(plan);
  if (!reader.header().mill)
    throw InputError("trajectory_invalid", "the trajectory has no milling tools: there is no surface as machined");
  const Mesh fine = refine(std::move(part), grid.n * grid.voxel_m / edges_along, enough_triangles);
  const std::vector<std::optional<Vec3>> normals = normals_of(fine, voxels, grid);
  std::vector<SurfacePoint> vertices;
  MachinedSurface surface = keep_sided(fine, normals, vertices);
  SurfacePoints points(vertices, grid, near_of(reader.header().mill->tools));
  VoxelSet standing = voxels.stock;
  carry_out(reader, points, standing, voxels.keep.size(), grid, watch);
  surface.excess_m = points.judge(standing).excess_m;
  for (std::size_t vertex = 0; vertex < vertices.size(); ++vertex)
    surface.mesh.vertices[vertex] += surface.excess_m[vertex] * vertices[vertex].normal;
  return surface;
}

}  // namespace sculpt
