#include "server/run/translate.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "core/base/sha256.hpp"
#include "tests/server/temp_folder.hpp"

namespace sculpt::server {
namespace {

constexpr std::uint64_t huge = 1ull << 40;

class MeasureTest : public testing::Test {
 protected:
  // Takes no room on the disk and could not be read into any memory.
  std::string add_huge(const std::string& content) {
    const std::string sha256 = blobs.add(content);
    std::filesystem::resize_file(folder.path() / sha256.substr(0, 2) / sha256, huge);
    return sha256;
  }

  TempFolder folder;
  Blobs blobs{folder.path(), 1 << 20};
};

TEST_F(MeasureTest, NothingIsReadButTheListOfTheCellsFiles) {
  proto::CellBundle bundle{"cell", "{}", {}};
  const std::string mesh = add_huge("cell mesh");
  for (int i = 0; i < 900; ++i) bundle.files["mesh " + std::to_string(i)] = mesh;
  proto::JobSpec spec;
  spec.mesh = {add_huge("mesh"), "a.b.STL"};
  spec.stock_mesh = proto::BlobRef{add_huge("stock"), "s.ply"};
  spec.resolution = 64;
  const JobSizes sizes = measure(spec, blobs.add(proto::write_cell_bundle(bundle)), blobs);
  EXPECT_EQ(sizes.resolution, 64);
  EXPECT_EQ(sizes.mesh.bytes, huge);
  EXPECT_EQ(sizes.mesh.extension, "stl");
  EXPECT_EQ(sizes.stock->bytes, huge);
  EXPECT_EQ(sizes.stock->extension, "ply");
  EXPECT_EQ(sizes.cell_bytes, 900 * huge + 2);
  EXPECT_GT(predict_memory(sizes), sizes.cell_bytes);
}

TEST_F(MeasureTest, SaysWhichFileIsMissing) {
  const auto pointer = [&](const proto::JobSpec& spec, const std::string& bundle) -> std::string {
    try {
      measure(spec, bundle, blobs);
      return "none";
    } catch (const proto::ProtocolError& error) {
      return error.code() + " " + error.pointer();
    }
  };
  const std::string here = blobs.add("mesh"), gone = sha256_hex("gone");
  const std::string whole = blobs.add(proto::write_cell_bundle({"cell", "{}", {{"a.urdf", here}}}));
  const std::string lacks = blobs.add(proto::write_cell_bundle({"cell", "{}", {{"a.urdf", gone}}}));
  proto::JobSpec spec;
  spec.mesh = {here, "a.stl"};
  EXPECT_EQ(pointer(spec, whole), "none");
  EXPECT_EQ(pointer(spec, lacks), "blob_missing /params/spec/robot/cell/blob");
  spec.stock_mesh = proto::BlobRef{gone, "s.stl"};
  EXPECT_EQ(pointer(spec, whole), "blob_missing /params/spec/stock/mesh/blob");
  spec.mesh = {gone, "a.stl"};
  EXPECT_EQ(pointer(spec, whole), "blob_missing /params/spec/mesh/blob");
  spec.mesh = {here, "a"};
  EXPECT_EQ(pointer(spec, whole), "params_invalid /params/spec/mesh/name");
}

}  // namespace
}  // namespace sculpt::server
