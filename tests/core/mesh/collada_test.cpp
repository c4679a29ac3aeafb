// Collada files, as makers of robots give them.
#include <gtest/gtest.h>

#include "core/mesh/mesh_file.hpp"
#include "tests/core/material/shapes.hpp"

namespace sculpt {
namespace {

/// A tetrahedron with edges of one unit along the axes, in a node that shifts it by `shift`.
std::string collada(const std::string& asset, const std::string& shift = "0 0 0") {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>)" +
         asset + R"(</asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 0 1 0 0 0 2 0 0 0 3</float_array>
<technique_common><accessor source="#pa" count="4" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist count="4"><input semantic="VERTEX" source="#v" offset="0"/>
<vcount>3 3 3 3</vcount><p>0 2 1 0 1 3 1 2 3 0 3 2</p></polylist></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><translate>)" +
         shift + R"(</translate><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

Eigen::AlignedBox3d box_of(const std::string& bytes) {
  Eigen::AlignedBox3d box;
  for (const Vec3& vertex : load_mesh(bytes, "dae", 1ull << 30, {}).vertices) box.extend(vertex);
  return box;
}

void expect_box(const std::string& bytes, const Vec3& low, const Vec3& high) {
  const Eigen::AlignedBox3d box = box_of(bytes);
  EXPECT_TRUE((box.min() - low).isZero(1e-6) && (box.max() - high).isZero(1e-6))
      << box.min().transpose() << " to " << box.max().transpose();
}

TEST(Collada, CoordinatesAreTheFilesWhateverAxisItCallsUp) {
  for (const char* up : {"X_UP", "Y_UP", "Z_UP"})
    expect_box(collada("<unit meter='1'/><up_axis>" + std::string(up) + "</up_axis>"), {0, 0, 0}, {1, 2, 3});
}

TEST(Collada, TheUnitOfTheFileIsApplied) {
  expect_box(collada("<unit name='millimeter' meter='0.001'/>"), {0, 0, 0}, {0.001, 0.002, 0.003});
  expect_box(collada("<unit meter='0.0254'/><up_axis>Z_UP</up_axis>"), {0, 0, 0}, {0.0254, 0.0508, 0.0762});
}

TEST(Collada, NodesAreWhereTheSceneHasThem) {
  expect_box(collada("<unit meter='1'/>", "10 20 30"), {10, 20, 30}, {11, 22, 33});
}

TEST(Collada, AFileThatIsNoneIsRefused) {
  for (const char* bytes : {"", "solid x", "<COLLADA/>", "<?xml version='1.0'?><COLLADA version='1.4.1'></COLLADA>"})
    EXPECT_EQ(shapes::error_code([&] { load_mesh(bytes, "dae", 1ull << 30, {}); }), "mesh_unreadable") << bytes;
}

}  // namespace
}  // namespace sculpt
