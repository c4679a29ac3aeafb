// Small meshes with known insides, and the bytes of mesh files, for the tests of core/material.
#pragma once

#include <functional>
#include <string>

#include "core/base/random.hpp"
#include "core/material/voxel_grid.hpp"
#include "core/mesh/mesh.hpp"

namespace sculpt::shapes {

/// Axis-aligned box as 12 triangles; `sides` of 0b111111 are present, in the order -x +x -y +y -z +z.
Mesh box(const Vec3& low, const Vec3& high, unsigned sides = 0b111111);
/// A closed surface of revolution about z; the profile is (radius, z) and must start and end on the axis (radius 0).
Mesh revolution(const std::vector<std::array<double, 2>>& profile, int segments);
Mesh sphere(const Vec3& centre, double radius, int segments = 48);
/// Ring about z with centre line radius `major` and tube radius `minor`.
Mesh torus(const Vec3& centre, double major, double minor, int segments = 64);
Mesh transformed(Mesh mesh, const Frame& frame);
Mesh joined(Mesh a, const Mesh& b);
Frame random_frame(Random& random, const Vec3& at);

/// 80 bytes of header, then the triangles with zero normals.
std::string binary_stl(const Mesh& mesh);
std::string ascii_stl(const Mesh& mesh);
std::string obj(const Mesh& mesh);

/// Signed volume by the divergence theorem; right only for a closed surface whose triangles all turn the same way.
double volume(const Mesh& mesh);

/// All voxels from `low` to `high`, both included.
void fill(VoxelSet& set, Voxel low, Voxel high);
/// Those of a straight row, from `first` to `last`.
std::vector<Voxel> row_of(Voxel first, Voxel last);
/// What no path of standing voxels joins to layer 0: breadth-first, voxel by voxel.
VoxelSet loose_by_brute_force(const VoxelSet& standing);
/// Face-connected.
std::vector<std::vector<Voxel>> pieces_of(VoxelSet voxels);
/// Those of a box somewhere that stand.
std::vector<Voxel> random_box_of(const VoxelSet& standing, Random& random);

/// A random grid of blobs (union of boxes) or of noise, with some air at the top; keep is a subset of stock.
VoxelGrid random_grid(int n, std::uint64_t seed);
/// With holes all over it: of pieces that hang together at few places.
VoxelGrid crumbled(VoxelGrid grid, Random& random);

/// The content of a file of the shared data folder, empty where it is missing.
std::string shared_data(const std::string& path);

/// Code of the InputError thrown by `work`; "" when nothing is thrown.
std::string error_code(const std::function<void()>& work);
/// Sentence of the InputError thrown by `work`; "" when nothing is thrown.
std::string error_sentence(const std::function<void()>& work);

}  // namespace sculpt::shapes
