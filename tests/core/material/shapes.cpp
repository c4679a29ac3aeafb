#include "tests/core/material/shapes.hpp"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <numbers>
#include <sstream>

#include "core/base/error.hpp"

namespace sculpt::shapes {
namespace {

constexpr double pi = std::numbers::pi;

Voxel random_voxel(Random& random, int n) {
  return {static_cast<int>(random.between(0, n)), static_cast<int>(random.between(0, n)),
          static_cast<int>(random.between(0, n))};
}

void fill_box(VoxelSet& set, Voxel low, Voxel size, bool value) {
  for (int k = low.k; k < std::min(low.k + size.k, set.n()); ++k)
    for (int j = low.j; j < std::min(low.j + size.j, set.n()); ++j)
      for (int i = low.i; i < std::min(low.i + size.i, set.n()); ++i)
        value ? set.insert({i, j, k}) : set.erase({i, j, k});
}

std::string triangles_as_text(const Mesh& mesh,
                              const std::function<void(std::ostream&, const std::array<Vec3, 3>&)>& put) {
  std::ostringstream text;
  text.precision(9);
  for (const auto& t : mesh.triangles) put(text, {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
  return text.str();
}

}  // namespace

Mesh box(const Vec3& low, const Vec3& high, unsigned sides) {
  Mesh mesh;
  for (int corner = 0; corner < 8; ++corner)
    mesh.vertices.emplace_back((corner & 1 ? high : low).x(), (corner & 2 ? high : low).y(),
                               (corner & 4 ? high : low).z());
  constexpr std::uint32_t quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (int side = 0; side < 6; ++side) {
    if (!(sides >> side & 1)) continue;
    const auto& q = quads[side];
    mesh.triangles.push_back({q[0], q[1], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[3]});
  }
  return mesh;
}

Mesh revolution(const std::vector<std::array<double, 2>>& profile, int segments) {
  Mesh mesh;
  std::vector<std::uint32_t> first;  // of each ring; a ring on the axis has one vertex
  for (const auto& [radius, z] : profile) {
    first.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
    const int count = radius == 0 ? 1 : segments;
    for (int s = 0; s < count; ++s)
      mesh.vertices.emplace_back(radius * std::cos(2 * pi * s / segments), radius * std::sin(2 * pi * s / segments), z);
  }
  const auto at = [&](std::size_t ring, int s) {
    return profile[ring][0] == 0 ? first[ring] : first[ring] + static_cast<std::uint32_t>(s % segments);
  };
  for (std::size_t ring = 0; ring + 1 < profile.size(); ++ring) {
    for (int s = 0; s < segments; ++s) {
      const std::uint32_t a = at(ring, s), b = at(ring, s + 1), c = at(ring + 1, s + 1), d = at(ring + 1, s);
      if (a != b) mesh.triangles.push_back({a, b, c});
      if (c != d) mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

Mesh sphere(const Vec3& centre, double radius, int segments) {
  std::vector<std::array<double, 2>> profile;
  for (int s = 0; s <= segments / 2; ++s) {
    const double angle = 2 * pi * s / segments;
    const bool pole = s == 0 || 2 * s == segments;
    profile.push_back({pole ? 0 : radius * std::sin(angle), -radius * std::cos(angle)});
  }
  return transformed(revolution(profile, segments), Frame(Eigen::Translation3d(centre)));
}

Mesh torus(const Vec3& centre, double major, double minor, int segments) {
  Mesh mesh;
  const auto count = static_cast<std::uint32_t>(segments);
  for (std::uint32_t a = 0; a < count; ++a) {
    for (std::uint32_t b = 0; b < count; ++b) {
      const double u = 2 * pi * a / count, v = 2 * pi * b / count, r = major + minor * std::cos(v);
      mesh.vertices.push_back(centre + Vec3(r * std::cos(u), r * std::sin(u), minor * std::sin(v)));
      const std::uint32_t p = a * count + b, q = (a + 1) % count * count + b;
      const std::uint32_t r1 = (a + 1) % count * count + (b + 1) % count, s = a * count + (b + 1) % count;
      mesh.triangles.push_back({p, q, r1});
      mesh.triangles.push_back({p, r1, s});
    }
  }
  return mesh;
}

Mesh transformed(Mesh mesh, const Frame& frame) {
  for (Vec3& vertex : mesh.vertices) vertex = frame * vertex;
  return mesh;
}

Mesh joined(Mesh a, const Mesh& b) {
  const auto offset = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& t : b.triangles) a.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  return a;
}

Frame random_frame(Random& random, const Vec3& at) {
  Frame frame = Frame::Identity();
  frame.translate(at);
  const auto angle = [&random] { return random.between(-pi, pi); };
  frame.rotate(Eigen::AngleAxisd(angle(), Vec3::UnitZ()));
  frame.rotate(Eigen::AngleAxisd(angle(), Vec3::UnitY()));
  frame.rotate(Eigen::AngleAxisd(angle(), Vec3::UnitX()));
  return frame;
}

std::string binary_stl(const Mesh& mesh) {
  std::string bytes(80, ' ');
  const auto put = [&bytes](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& t : mesh.triangles) {
    for (int c = 0; c < 3; ++c) put(0.0f);
    for (std::uint32_t id : t)
      for (int c = 0; c < 3; ++c) put(static_cast<float>(mesh.vertices[id][c]));
    put(std::uint16_t{0});
  }
  return bytes;
}

std::string ascii_stl(const Mesh& mesh) {
  return "solid test\n" +
         triangles_as_text(mesh,
                           [](std::ostream& out, const std::array<Vec3, 3>& t) {
                             out << "facet normal 0 0 1\n outer loop\n";
                             for (const Vec3& p : t) out << "  vertex " << p.transpose() << '\n';
                             out << " endloop\nendfacet\n";
                           }) +
         "endsolid test\n";
}

std::string obj(const Mesh& mesh) {
  return triangles_as_text(mesh, [](std::ostream& out, const std::array<Vec3, 3>& t) {
    for (const Vec3& p : t) out << "v " << p.transpose() << '\n';
    out << "f -3 -2 -1\n";
  });
}

VoxelGrid random_grid(int n, std::uint64_t seed) {
  Random random(seed);
  VoxelGrid grid{VoxelSet(n, true), VoxelSet(n)};
  const bool noise = random.unit() < 0.3;
  if (noise) {
    const double share = random.unit();
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
          if (random.unit() < share) grid.keep.insert({i, j, k});
  } else {
    const int boxes = static_cast<int>(random.between(0, 8));
    for (int b = 0; b < boxes; ++b)
      fill_box(grid.keep, random_voxel(random, n), random_voxel(random, n), random.unit() < 0.8);
  }
  const int holes = static_cast<int>(random.between(0, 4));
  for (int h = 0; h < holes; ++h) {
    const Voxel low = random_voxel(random, n), size = random_voxel(random, n);
    fill_box(grid.stock, low, size, false);
    fill_box(grid.keep, low, size, false);
  }
  return grid;
}

VoxelGrid crumbled(VoxelGrid grid, Random& random) {
  const double share = 0.3 + 0.7 * random.unit();
  VoxelSet crumbs(grid.n());
  for_each_voxel(grid.stock, [&](Voxel v) {
    if (random.unit() > share) crumbs.insert(v);
  });
  grid.stock -= crumbs;
  grid.keep -= crumbs;
  return grid;
}

double volume(const Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6;
  return sum;
}

void fill(VoxelSet& set, Voxel low, Voxel high) {
  for (int k = low.k; k <= high.k; ++k)
    for (int j = low.j; j <= high.j; ++j)
      for (int i = low.i; i <= high.i; ++i) set.insert({i, j, k});
}

std::vector<Voxel> row_of(Voxel first, Voxel last) {
  const auto sign = [](int value) { return (value > 0) - (value < 0); };
  const Voxel way{sign(last.i - first.i), sign(last.j - first.j), sign(last.k - first.k)};
  std::vector<Voxel> all{first};
  while (all.back() != last) all.push_back(all.back() + way);
  return all;
}

VoxelSet loose_by_brute_force(const VoxelSet& standing) {
  const Grid bounds{standing.n(), 1, Vec3::Zero()};
  VoxelSet loose = standing;
  std::vector<Voxel> queue;
  for_each_voxel(standing, [&](Voxel voxel) {
    if (voxel.k == 0) queue.push_back(voxel);
  });
  for (Voxel voxel : queue) loose.erase(voxel);
  for (std::size_t at = 0; at < queue.size(); ++at)
    for (Voxel step : face_steps) {
      const Voxel next = queue[at] + step;
      if (!bounds.contains(next) || !loose.contains(next)) continue;
      loose.erase(next);
      queue.push_back(next);
    }
  return loose;
}

std::vector<std::vector<Voxel>> pieces_of(VoxelSet voxels) {
  const Grid bounds{voxels.n(), 1, Vec3::Zero()};
  std::vector<std::vector<Voxel>> pieces;
  const VoxelSet all = voxels;
  for_each_voxel(all, [&](Voxel start) {
    if (!voxels.contains(start)) return;
    voxels.erase(start);
    std::vector<Voxel> piece{start};
    for (std::size_t at = 0; at < piece.size(); ++at)
      for (Voxel step : face_steps) {
        const Voxel next = piece[at] + step;
        if (!bounds.contains(next) || !voxels.contains(next)) continue;
        voxels.erase(next);
        piece.push_back(next);
      }
    pieces.push_back(std::move(piece));
  });
  return pieces;
}

std::vector<Voxel> random_box_of(const VoxelSet& standing, Random& random) {
  VoxelSet box(standing.n());
  fill_box(box, random_voxel(random, standing.n()), random_voxel(random, standing.n()), true);
  std::vector<Voxel> voxels;
  for_each_voxel(box, [&](Voxel voxel) {
    if (standing.contains(voxel)) voxels.push_back(voxel);
  });
  return voxels;
}

std::string shared_data(const std::string& path) {
  const char* folder = std::getenv("SCULPT_SHARED_DATA");
  std::ifstream file((folder != nullptr ? std::string(folder) : SOURCE_DIR "/../shared/data") + "/" + path,
                     std::ios::binary);
  std::ostringstream bytes;
  if (file) bytes << file.rdbuf();
  return bytes.str();
}

std::string error_code(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.code();
  }
  return "";
}

std::string error_sentence(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace sculpt::shapes
