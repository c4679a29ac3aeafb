#include "core/plan/output/surface_file.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <ostream>

#include "core/plan/intake.hpp"
#include "core/verify/mill/machined_surface.hpp"

namespace sculpt {
namespace {

constexpr std::size_t bytes_sent_at_once = 1 << 20;

template <typename Number>
void append_bytes(std::string& out, Number number) {
  static_assert(std::endian::native == std::endian::little);
  out.append(reinterpret_cast<const char*>(&number), sizeof(Number));
}

void append_colour(std::string& out, double excess_m, double tolerance_m) {
  constexpr double worst = 10;
  const double share = std::clamp((excess_m / tolerance_m - 1) / (worst - 1), 0.0, 1.0);
  const auto byte = [](double value) { return static_cast<char>(std::lround(255 * value)); };
  out += byte(std::min(1.0, 0.2 + 1.6 * share));
  out += byte(share < 0.5 ? 0.75 : 1.5 * (1 - share));
  out += byte(0.2);
}

void write_ply(const MachinedSurface& surface, double tolerance_m, std::ostream& out) {
  const auto& [vertices, triangles] = surface.mesh;
  out << "ply\nformat binary_little_endian 1.0\ncomment metres; excess_m stands above the surface that was ordered\n"
      << "element vertex " << vertices.size()
      << "\nproperty float x\nproperty float y\nproperty float z\nproperty float excess_m\n"
      << "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face " << triangles.size()
      << "\nproperty list uchar int vertex_indices\nend_header\n";
  std::string bytes;
  const auto send = [&](std::size_t least) {
    if (bytes.size() < least) return;
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.clear();
  };
  for (std::size_t at = 0; at < vertices.size(); ++at, send(bytes_sent_at_once)) {
    for (int axis = 0; axis < 3; ++axis) append_bytes(bytes, static_cast<float>(vertices[at][axis]));
    append_bytes(bytes, static_cast<float>(surface.excess_m[at]));
    append_colour(bytes, surface.excess_m[at], tolerance_m);
  }
  for (const auto& triangle : triangles) {
    bytes += '\3';
    for (const std::uint32_t vertex : triangle) append_bytes(bytes, static_cast<std::int32_t>(vertex));
    send(bytes_sent_at_once);
  }
  send(0);
}

}  // namespace

void write_machined_surface(const Job& job, std::istream& plan, std::ostream& ply, const Watch& watch) {
  const Grid grid = parse_cell(job.cell).grid(job.resolution);
  JobShapes shapes(job);
  Mesh part = shapes.place_part(grid, watch);
  const VoxelGrid voxels = std::move(shapes).take_voxels(grid, watch);
  const MachinedSurface surface = machined_surface(plan, std::move(part), voxels, grid, watch);
  write_ply(surface, job.mill ? job.mill->tolerance_m : MillOrder{}.tolerance_m, ply);
}

}  // namespace sculpt
