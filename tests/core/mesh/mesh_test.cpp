#include "core/mesh/mesh.hpp"

#include <gtest/gtest.h>

#include "core/mesh/mesh_file.hpp"
#include "tests/core/material/shapes.hpp"
#include "tests/core/mesh/gltf_files.hpp"

namespace sculpt {
namespace {

constexpr std::uint64_t cap = 1ull << 30;

Mesh load(const std::string& bytes, const std::string& extension) {
  return load_mesh(bytes, extension, cap, {});
}

Eigen::AlignedBox3d bounds(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vec3& vertex : mesh.vertices) box.extend(vertex);
  return box;
}

const Mesh sample_box = shapes::box(Vec3(1, 2, 3), Vec3(2, 4, 6));

TEST(Mesh, StlInBothFormsAndObjGiveTheSameSolid) {
  const std::vector<std::pair<std::string, std::string>> files{{shapes::binary_stl(sample_box), "stl"},
                                                               {shapes::ascii_stl(sample_box), "stl"},
                                                               {shapes::obj(sample_box), "obj"}};
  for (const auto& [bytes, extension] : files) {
    SCOPED_TRACE(bytes.substr(0, 20));
    const Mesh mesh = load(bytes, extension);
    EXPECT_EQ(mesh.vertices.size(), 8u) << "corners that coincide are joined";
    EXPECT_EQ(mesh.triangles.size(), 12u);
    EXPECT_NEAR(std::abs(shapes::volume(mesh)), 6, 1e-6);
    EXPECT_TRUE(bounds(mesh).min().isApprox(Vec3(1, 2, 3)));
  }
}

TEST(Mesh, ABinaryStlWhoseHeaderSaysSolidIsRead) {
  std::string bytes = shapes::binary_stl(sample_box);
  bytes.replace(0, 6, "solid ");
  EXPECT_EQ(load(bytes, "stl").triangles.size(), 12u);
}

TEST(Mesh, PolygonsBecomeTriangles) {
  const std::string corners = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 1\nv 2 0 1\nv 2 2 1\nv 0 2 1\n";
  const std::string quads = "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  const Mesh mesh = load(corners + quads, "obj");
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_NEAR(shapes::volume(mesh), 4, 1e-9);
}

TEST(Mesh, ConcavePolygonsKeepTheirArea) {
  const std::string prism =
      "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nv 0 0 1\nv 4 0 1\nv 4 4 1\nv 2 1 1\nv 0 4 1\n"
      "f 5 4 3 2 1\nf 6 7 8 9 10\nf 1 2 7 6\nf 2 3 8 7\nf 3 4 9 8\nf 4 5 10 9\nf 5 1 6 10\n";
  EXPECT_NEAR(shapes::volume(load(prism, "obj")), 10, 1e-6);
}

TEST(Mesh, PlyAsTextAndAsBytesIsRead) {
  const std::string vertices = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string faces = "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string text =
      "ply\nformat ascii 1.0\n" + vertices + faces + "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
  EXPECT_NEAR(shapes::volume(load(text, "ply")), 1.0 / 6, 1e-9);
  std::string bytes = "ply\nformat binary_little_endian 1.0\n" + vertices + faces;
  const auto put = [&bytes](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  for (float f : {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) put(f);
  constexpr int indices[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  for (const auto& face : indices) {
    put(std::uint8_t{3});
    for (int index : face) put(index);
  }
  EXPECT_NEAR(shapes::volume(load(bytes, "ply")), 1.0 / 6, 1e-9);
}

TEST(Mesh, NodeTransformsOfGltfAreAppliedToEveryAppearance) {
  const std::string nodes =
      R"([{"children":[1,2],"translation":[10,0,0]},{"mesh":0,"scale":[2,2,2]},{"mesh":0,"translation":[0,5,0]}])";
  for (const auto& [bytes, extension] :
       {std::pair{gltf_files::embedded(nodes), "gltf"}, std::pair{gltf_files::binary(nodes), "glb"}}) {
    SCOPED_TRACE(extension);
    const Mesh mesh = load(bytes, extension);
    EXPECT_EQ(mesh.triangles.size(), 8u);
    EXPECT_NEAR(shapes::volume(mesh), (8 + 1) / 6.0, 1e-5);
    EXPECT_TRUE(bounds(mesh).min().isApprox(Vec3(10, 0, 0))) << bounds(mesh).min().transpose();
    EXPECT_TRUE(bounds(mesh).max().isApprox(Vec3(12, 6, 2))) << bounds(mesh).max().transpose();
  }
}

TEST(Mesh, SeveralSubMeshesAreAllRead) {
  const std::string two =
      "o first\n" + shapes::obj(sample_box) + "o second\n" + shapes::obj(shapes::sphere(Vec3::Zero(), 1, 16));
  EXPECT_EQ(load(two, "obj").triangles.size(), 12u + shapes::sphere(Vec3::Zero(), 1, 16).triangles.size());
}

TEST(Mesh, DegenerateTrianglesPointsAndLinesAreDropped) {
  const std::string extra =
      "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 0 0\n"
      "f -4 -3 -2\n"  // three points of a line
      "f -4 -3 -1\n"  // two corners at one point
      "f -4 -4 -3\n"  // one corner named twice
      "l -4 -3\np -4\n";
  const Mesh mesh = load(shapes::obj(sample_box) + extra, "obj");
  EXPECT_EQ(mesh.triangles.size(), 12u);
}

TEST(Mesh, MinusZeroAndZeroAreOnePoint) {
  const Mesh mesh = load("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv -0.0 0 -0.0\nf 1 2 3\nf 5 2 4\n", "obj");
  EXPECT_EQ(mesh.vertices.size(), 4u);
}

TEST(Mesh, DavidIsWatertightOnceHisCornersAreJoined) {
  const std::string bytes = shapes::shared_data("meshes/david.stl");
  if (bytes.empty()) GTEST_SKIP() << "shared data folder without meshes/david.stl";
  const Mesh mesh = load(bytes, "stl");
  EXPECT_EQ(mesh.triangles.size(), 50000u);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& t : mesh.triangles)
    for (int e = 0; e < 3; ++e) edges.emplace_back(std::minmax(t[e], t[(e + 1) % 3]));
  std::sort(edges.begin(), edges.end());
  for (std::size_t at = 0; at + 1 < edges.size(); at += 2) ASSERT_EQ(edges[at], edges[at + 1]);
}

}  // namespace
}  // namespace sculpt
