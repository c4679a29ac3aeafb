#include "core/mesh/off.hpp"

#include <gtest/gtest.h>

#include "core/mesh/mesh_file.hpp"
#include "tests/core/material/shapes.hpp"

namespace sculpt {
namespace {

using Triangles = decltype(Mesh::triangles);

std::string said(const std::string& bytes) {
  const auto work = [&] { load_mesh(bytes, "off", 1u << 30, {}); };
  EXPECT_EQ(shapes::error_code(work), "mesh_unreadable");
  return shapes::error_sentence(work);
}

TEST(Off, NormalsColoursAndCommentsAreSkipped) {
  const std::string faces = "3 0 2 1 0.5 0.5 0.5\n3 0 1 3\n 3 1 2 3 # the slanted one\n3 0 3 2\n";
  for (const std::string begin :
       {"OFF\n# a comment\n\n4 4 6\n", "OFF 4 4 6\n", "NOFF\r\n4 4 0\r\n", "STCNOFF\n4 4\n"}) {
    const Mesh mesh = read_off(begin + "0 0 0 1 1 1\n1 0 0\n0 1e0 0\n0 0 +1\n" + faces);
    EXPECT_EQ(mesh.vertices.size(), 4u);
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}));
  }
}

TEST(Off, MoreThanTheFileHoldsIsRefusedBeforeItIsMade) {
  for (const char* counts : {"2000000000 1 0", "3 2000000000 0", "1e18 1 0", "-1 1 0", "3 1.5 0", "nan 1 0"})
    EXPECT_NE(said(std::string("OFF\n") + counts + "\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").find("(line 2)"),
              std::string::npos)
        << counts;
  EXPECT_NE(said("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2000000000 0 1 2\n").find("(line 6)"), std::string::npos);
}

TEST(Off, ErrorsNameTheLine) {
  EXPECT_NE(said("OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n").find("has too few numbers (line 4)"), std::string::npos);
  EXPECT_NE(said("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n").find("below the number of vertices, 3 (line 6)"),
            std::string::npos);
  EXPECT_NE(said("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n").find("ends before it is complete"), std::string::npos);
  EXPECT_NE(said("OFF BINARY\n").find("no number"), std::string::npos);
}

}  // namespace
}  // namespace sculpt
