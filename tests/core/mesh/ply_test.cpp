#include "core/mesh/ply.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/mesh/mesh_file.hpp"
#include "tests/core/material/shapes.hpp"

namespace sculpt {
namespace {

using Triangles = decltype(Mesh::triangles);

constexpr std::uint64_t cap = 1u << 30;
const std::string corners = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string places = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";

Mesh load(const std::string& bytes) {
  return load_mesh(bytes, "ply", cap, {});
}
std::string said(const std::string& bytes) {
  const auto work = [&] { load(bytes); };
  EXPECT_EQ(shapes::error_code(work), "mesh_unreadable");
  return shapes::error_sentence(work);
}

/// Numbers one after the other, in the byte order of the machine or the other.
class Bytes {
 public:
  explicit Bytes(bool big_endian) : big_endian_(big_endian) {}
  template <typename T>
  Bytes& put(T value) {
    std::array<char, sizeof(T)> raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if (big_endian_ == (std::endian::native == std::endian::little)) std::reverse(raw.begin(), raw.end());
    text.append(raw.begin(), raw.end());
    return *this;
  }
  std::string text;

 private:
  bool big_endian_;
};

TEST(Ply, EveryNumberTypeInBothByteOrders) {
  for (bool big : {false, true}) {
    SCOPED_TRACE(big);
    Bytes bytes(big);
    bytes.text = std::string("ply\r\nformat binary_") + (big ? "big" : "little") +
                 "_endian 1.0\r\ncomment \xff\r\nobj_info x\r\nelement vertex 4\r\nproperty uchar red\r\n"
                 "property double x\r\nproperty list ushort int8 more\r\nproperty short y\r\nproperty uint z\r\n"
                 "element face 4\r\nproperty uint16 flags\r\nproperty list uint32 int32 vertex_index\r\nend_header\r\n";
    for (const auto& [x, y, z] : {std::array{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
      bytes.put<std::uint8_t>(200)
          .put<double>(x)
          .put<std::uint16_t>(2)
          .put<std::int8_t>(-1)
          .put<std::int8_t>(1)
          .put(static_cast<std::int16_t>(-y))
          .put(static_cast<std::uint32_t>(z));
    for (const auto& face : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}) {
      bytes.put<std::uint16_t>(7).put<std::uint32_t>(3);
      for (std::int32_t corner : face) bytes.put(corner);
    }
    EXPECT_NEAR(shapes::volume(load(bytes.text)), -1.0 / 6, 1e-12);
    for (std::size_t cut = 1; cut < 60; ++cut) said(bytes.text.substr(0, bytes.text.size() - cut));
  }
}

TEST(Ply, LinesMayEndInThreeWays) {
  const std::string text = "ply\nformat ascii 1.0\n" + corners +
                           "element face 4\nproperty list uchar int vertex_indices\nend_header\n" + places +
                           "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2";
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string other;
    for (char c : text) c == '\n' ? other += end : other += c;
    EXPECT_NEAR(shapes::volume(load(other)), 1.0 / 6, 1e-12) << end.size();
  }
}

// The export of a scanner was read as 1 of 268 686 triangles.
TEST(Ply, StripsAreRead) {
  const std::string text = "ply\nformat ascii 1.0\n" + corners +
                           "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" + places;
  EXPECT_NEAR(shapes::volume(load(text + "14 0 2 1 -1 0 1 3 2 -1 3 2 0 0 -1\n")), 1.0 / 6, 1e-12);
  const Mesh grid = load(text + "4 0 1 2 3\n");
  EXPECT_EQ(grid.triangles, (Triangles{{0, 1, 2}, {1, 3, 2}})) << "every second triangle is turned";
}

TEST(Ply, PolygonsKeepTheirAreaAndStayInThemselves) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const Mesh arrow = load(header + "0 0 0\n4 0 0\n4 4 0\n2 1 0\n0 4 0\n5 0 1 2 3 4\n");
  double area = 0;
  for (const auto& t : arrow.triangles)
    area += (arrow.vertices[t[1]] - arrow.vertices[t[0]]).cross(arrow.vertices[t[2]] - arrow.vertices[t[0]]).norm() / 2;
  EXPECT_NEAR(area, 10, 1e-12);
}

// 187 bytes took the machine's memory.
TEST(Ply, AListLongerThanTheFileIsRefusedBeforeItIsMade) {
  for (const char* form : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const std::string header = std::string("ply\nformat ") + form + " 1.0\n" + corners +
                               "element face 1\nproperty list int int vertex_indices\nend_header\n";
    const bool is_text = form[0] == 'a';
    Bytes bytes(std::string_view(form) == "binary_big_endian");
    for (int number = 0; number < 12; ++number) bytes.put(0.0f);
    bytes.put<std::int32_t>(2147483647);
    const std::string told = said(header + (is_text ? places + "2147483647 0 1 2\n" : bytes.text));
    EXPECT_NE(told.find("face 0"), std::string::npos) << told;
    EXPECT_NE(told.find("length cannot be, 2147483647"), std::string::npos) << told;
    EXPECT_NE(told.find(is_text ? "(line 14)" : "(byte "), std::string::npos) << told;
  }
}

TEST(Ply, MoreElementsThanTheFileHoldsAreRefused) {
  const std::string begin = "ply\nformat ascii 1.0\nelement vertex ", rest = "\nproperty float x\nend_header\n";
  for (const char* count : {"4294967295", "18446744073709551615"})
    EXPECT_NE(said(begin + count + rest).find("more than its"), std::string::npos);
  EXPECT_NE(said("ply\nformat ascii 1.0\nelement nothing 1000000000000\nend_header\n").find("more than"),
            std::string::npos);
}

TEST(Ply, ErrorsNameTheElementAndItsLine) {
  const std::string header = "ply\nformat ascii 1.0\n" + corners +
                             "element face 2\nproperty list uchar int vertex_indices\nend_header\n" + places;
  const std::string missing = said(header + "3 0 1 2\n\n3 0 1 4\n");
  EXPECT_NE(missing.find("face 1 (line 16) names vertex 4, and there are 4 before it"), std::string::npos) << missing;
  EXPECT_NE(said(header + "3 0 1 2\n3 0 one 2\n").find("face 1 (line 15) has a word that is no number, \"one\""),
            std::string::npos);
  EXPECT_NE(said(header + "3 0 1 2\n3 0 1.5 2\n").find("vertex 1.5"), std::string::npos);
  EXPECT_NE(said(header + "3 0 1 2\n3 0 -1 2\n").find("vertex -1"), std::string::npos);
  EXPECT_NE(said(header + "3 0 1 2\n-3 0 1 2\n").find("length cannot be, -3"), std::string::npos);
  EXPECT_NE(said("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n0 0\n")
                .find("has not one x, one y and one z"),
            std::string::npos);
}

TEST(Ply, AFewBytesOfIndicesCannotBecomeMoreTrianglesThanTheCapHolds) {
  const std::string bytes = "ply\nformat ascii 1.0\n" + corners +
                            "element face 1\nproperty list int uchar vertex_indices\nend_header\n" + places;
  std::string corners_of_one;
  for (int corner = 0; corner < 100000; ++corner) corners_of_one += corner % 2 ? " 1" : " 2";
  EXPECT_EQ(shapes::error_code([&] { read_ply(bytes + "100000" + corners_of_one, 1 << 20); }), "memory_cap");
}

}  // namespace
}  // namespace sculpt
