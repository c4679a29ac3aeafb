#include "server/files/blobs.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "core/base/random.hpp"
#include "core/base/sha256.hpp"
#include "proto/error_codes.hpp"
#include "tests/server/temp_folder.hpp"

namespace sculpt::server {
namespace {

std::string error_of(const std::function<void()>& act) {
  try {
    act();
    return "none";
  } catch (const proto::ProtocolError& error) {
    return error.code();
  }
}

class BlobsTest : public testing::Test {
 protected:
  TempFolder folder;
  Blobs blobs{folder.path(), 1000};
  const std::string content = "the quick brown fox";
  const std::string hash = sha256_hex(content);
};

TEST_F(BlobsTest, ABlobInPiecesComesBackWhole) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    std::string bytes;
    for (std::size_t i = 0; i < 500; ++i) bytes += static_cast<char>(random.next());
    const std::string name = sha256_hex(bytes);
    BlobState state;
    while (!state.complete) {
      EXPECT_EQ(blobs.state(name).have, state.have);
      const std::size_t size = 1 + random.next() % 90;
      // At times a piece comes twice, as after a lost reply.
      const std::uint64_t offset = random.next() % 4 == 0 ? state.have / 2 : state.have;
      state = blobs.put(name, bytes.size(), offset, std::string_view(bytes).substr(offset, size));
    }
    EXPECT_EQ(blobs.read(name, ""), bytes);
    EXPECT_TRUE(blobs.state(name).complete);
  }
}

TEST_F(BlobsTest, AnUploadGoesOnUnderANewDaemon) {
  blobs.put(hash, content.size(), 0, content.substr(0, 7));
  Blobs later(folder.path(), 1000);
  EXPECT_EQ(later.state(hash).have, 7u);
  EXPECT_TRUE(later.put(hash, content.size(), 7, content.substr(7)).complete);
}

TEST_F(BlobsTest, BytesWithAnotherHashAreDropped) {
  EXPECT_EQ(error_of([&] { blobs.put(hash, content.size(), 0, std::string(content.size(), 'x')); }), "blob_mismatch");
  EXPECT_EQ(blobs.state(hash).have, 0u);
  EXPECT_TRUE(blobs.put(hash, content.size(), 0, content).complete);
}

TEST_F(BlobsTest, ALieAboutTheSizeHarmsNoOtherUpload) {
  blobs.put(hash, content.size(), 0, content.substr(0, 7));
  EXPECT_EQ(error_of([&] { blobs.put(hash, 7, 0, "xxxxxxx"); }), "blob_mismatch");
  blobs.put(hash, 900, 0, std::string(500, 'x'));
  EXPECT_EQ(error_of([&] { blobs.put(hash, 7, 7, ""); }), "offset_mismatch");
  EXPECT_TRUE(blobs.put(hash, content.size(), 7, content.substr(7)).complete);
  EXPECT_EQ(blobs.read(hash, ""), content);
}

TEST_F(BlobsTest, OfSeveralUploadsNoneIsOfferedToGoOnWith) {
  blobs.put(hash, content.size(), 0, content.substr(0, 7));
  EXPECT_EQ(blobs.state(hash).have, 7u);
  blobs.put(hash, 900, 0, "x");
  EXPECT_EQ(blobs.state(hash).have, 0u);
}

TEST_F(BlobsTest, AHoleIsRefused) {
  EXPECT_EQ(error_of([&] { blobs.put(hash, content.size(), 3, "x"); }), "offset_mismatch");
}

TEST_F(BlobsTest, ABlobOverTheLimitIsRefusedBeforeItsFirstByte) {
  EXPECT_EQ(error_of([&] { blobs.put(hash, 1001, 0, "x"); }), "too_large");
  EXPECT_EQ(blobs.state(hash).have, 0u);
}

TEST_F(BlobsTest, PuttingACompleteBlobAgainChangesNothing) {
  blobs.add(content);
  EXPECT_TRUE(blobs.put(hash, content.size(), 0, "rubbish").complete);
  EXPECT_EQ(blobs.read(hash, ""), content);
}

TEST_F(BlobsTest, AnUnfinishedBlobCannotBeRead) {
  blobs.put(hash, content.size(), 0, content.substr(0, 7));
  EXPECT_EQ(error_of([&] { blobs.read(hash, "/x"); }), "blob_missing");
}

TEST_F(BlobsTest, TheEmptyBlobIsABlob) {
  const std::string empty = sha256_hex("");
  EXPECT_TRUE(blobs.put(empty, 0, 0, "").complete);
  EXPECT_EQ(blobs.read(empty, ""), "");
}

}  // namespace
}  // namespace sculpt::server
