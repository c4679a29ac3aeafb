#include "core/mill/map/site.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {
namespace {

void raise(HeightMap& map, const Mesh& mesh, const ToolFrame& frame) {
  std::vector<Vec3> corners;
  corners.reserve(mesh.vertices.size());
  for (const Vec3& vertex : mesh.vertices) corners.push_back(frame.of(vertex));
  for (const auto& triangle : mesh.triangles)
    map.raise(corners[triangle[0]], corners[triangle[1]], corners[triangle[2]]);
}

}  // namespace

Site::Site(const ToolFrame& frame, const Lattice& lattice, const Assembly& assembly, const Mesh& part,
           const Mesh& fixtures, const SiteMargins& margins)
    : frame_(frame),
      cutter_(assembly.tool.cutter),
      rings_(assembly.rings),
      margins_(margins),
      limit_(lattice),
      beside_(lattice),
      stands_(lattice),
      body_limit_(lattice),
      lowest_cut_(Lattice{}) {
  HeightMap solid(lattice);
  raise(solid, fixtures, frame);
  beside_ = offset_by_cutter(solid, cutter_, margins.body_m);
  raise(solid, part, frame);
  beside_.raise(offset_by_rings(solid, rings_, margins.body_m));
  limit_ = offset_by_cutter(solid, cutter_, margins.cutter_m);
  limit_.raise(beside_);
}

void Site::see(const VoxelSet& standing, const Grid& grid, const Helpers& helpers) {
  stands_ = heights_of(standing, grid, frame_, limit_.lattice, helpers);
  body_limit_ = offset_by_rings(stands_, rings_, margins_.body_m, &helpers);
}

double Site::clear_height(const Vec3& from, const Vec3& to, double above_m, double beside_m) const {
  const Lattice& cells = limit_.lattice;
  const double beside = std::max(margins_.body_m, beside_m);
  float highest = no_height;
  for_each_cell_near(cells, from, to, cutter_.radius_m + beside,
                     [&](int a, int b) { highest = std::max(highest, stands_.at(a, b)); });
  for_each_cell_near(cells, from, to, beside, [&](int a, int b) {
    highest = std::max({highest, limit_.at(a, b), body_limit_.at(a, b)});
  });
  return static_cast<double>(highest) + above_m;
}

double Site::free_height(const Vec3& at, double clearance_m) const {
  const Cutter grown = grown_by(cutter_, clearance_m);
  const Lattice& cells = stands_.lattice;
  double lowest = static_cast<double>(no_height);
  for_each_cell_near(cells, at, at, grown.radius_m, [&](int a, int b) {
    const double off_u = std::max(0.0, std::abs(at.x() - cells.u(a)) - cells.step / 2),
                 off_v = std::max(0.0, std::abs(at.y() - cells.v(b)) - cells.step / 2);
    const double off = std::hypot(off_u, off_v);
    if (off > grown.radius_m) return;
    lowest = std::max(lowest, static_cast<double>(stands_.at(a, b)) - grown.height_m(off) + clearance_m);
  });
  return lowest;
}

}  // namespace sculpt
