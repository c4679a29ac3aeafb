#include "core/mill/map/site.hpp"

#include <algorithm>

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

double Site::clear_height(const Vec3& from, const Vec3& to, double clearance_m) const {
  float highest = no_height;
  const Lattice& cells = limit_.lattice;
  for_each_cell_near(cells, from, to, cutter_.radius_m + margins_.body_m,
                     [&](int a, int b) { highest = std::max(highest, stands_.at(a, b)); });
  for_each_cell_near(cells, from, to, margins_.body_m, [&](int a, int b) {
    highest = std::max({highest, limit_.at(a, b), body_limit_.at(a, b)});
  });
  return static_cast<double>(highest) + clearance_m;
}

}  // namespace sculpt
