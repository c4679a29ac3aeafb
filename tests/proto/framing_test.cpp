#include "proto/framing.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/random.hpp"

namespace sculpt::proto {
namespace {

// Lines that begin with "#n" announce a chunk of n bytes.
std::vector<std::string> take_all(FrameReader& reader) {
  std::vector<std::string> taken;
  while (const auto frame = reader.next()) {
    switch (frame->kind) {
      case WireFrame::Kind::line:
        taken.push_back("line " + frame->bytes);
        break;
      case WireFrame::Kind::chunk:
        taken.push_back("chunk " + frame->bytes);
        break;
      case WireFrame::Kind::too_long:
        taken.emplace_back("too long");
        break;
      case WireFrame::Kind::bad_chunk:
        taken.emplace_back("bad chunk");
        break;
    }
    if (frame->kind == WireFrame::Kind::line && frame->bytes.front() == '#') {
      reader.expect_chunk(std::stoul(frame->bytes.substr(1)));
    }
  }
  return taken;
}

const std::string stream = std::string("one\n\r\n#5\na\nb\0c\ntwo\r\n\n#0\n\nthree\n", 31);
const std::vector<std::string> frames{"line one", "line #5",   std::string("chunk a\nb\0c", 11), "line two", "line #0",
                                      "chunk ",   "line three"};

TEST(Framing, BytesAllAtOnceGiveEveryFrame) {
  FrameReader reader;
  reader.feed(stream);
  EXPECT_EQ(take_all(reader), frames);
  EXPECT_EQ(reader.pending(), 0u);
}

TEST(Framing, ASplitAtAnyTwoBytesChangesNothing) {
  for (std::size_t first = 0; first <= stream.size(); ++first) {
    for (std::size_t second = first; second <= stream.size(); ++second) {
      SCOPED_TRACE(std::to_string(first) + " " + std::to_string(second));
      FrameReader reader;
      std::vector<std::string> taken;
      for (const std::string& part :
           {stream.substr(0, first), stream.substr(first, second - first), stream.substr(second)}) {
        reader.feed(part);
        for (std::string& frame : take_all(reader)) taken.push_back(std::move(frame));
      }
      ASSERT_EQ(taken, frames);
    }
  }
}

TEST(Framing, RandomStreamsInRandomPiecesComeBackWhole) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    std::string bytes;
    std::vector<std::string> wanted;
    for (int i = 0; i < 30; ++i) {
      const std::size_t size = random.next() % 40;
      if (random.next() % 2 == 0) {
        bytes += std::string(size + 1, 'x') + (random.next() % 2 == 0 ? "\r\n" : "\n");
        wanted.push_back("line " + std::string(size + 1, 'x'));
      } else {
        std::string chunk;
        for (std::size_t k = 0; k < size; ++k) chunk += static_cast<char>(random.next());
        bytes += "#" + std::to_string(size) + "\n" + chunk + "\n";
        wanted.push_back("line #" + std::to_string(size));
        wanted.push_back("chunk " + chunk);
      }
    }
    FrameReader reader;
    std::vector<std::string> taken;
    for (std::size_t at = 0; at < bytes.size();) {
      const std::size_t size = 1 + random.next() % 17;
      reader.feed(std::string_view(bytes).substr(at, size));
      at += size;
      for (std::string& frame : take_all(reader)) taken.push_back(std::move(frame));
    }
    ASSERT_EQ(taken, wanted);
  }
}

TEST(Framing, ALineAtTheLimitIsTakenAndOneByteMoreIsNot) {
  for (const char* end : {"\n", "\r\n"}) {
    FrameReader fits(8);
    fits.feed("12345678" + std::string(end));
    EXPECT_EQ(take_all(fits), std::vector<std::string>{"line 12345678"});
    FrameReader over(8);
    over.feed("123456789" + std::string(end));
    EXPECT_EQ(take_all(over), std::vector<std::string>{"too long"});
  }
}

TEST(Framing, AnEndlessLineIsNoticedBeforeItsEndAndNothingIsTakenAfterIt) {
  FrameReader reader(8);
  reader.feed("1234567890");
  EXPECT_EQ(take_all(reader), std::vector<std::string>{"too long"});
  reader.feed("\nshort\n");
  EXPECT_TRUE(take_all(reader).empty());
  EXPECT_EQ(reader.pending(), 0u);
}

TEST(Framing, AChunkWithoutItsNewlineBreaksTheStream) {
  FrameReader reader;
  reader.feed("#3\nabcd\nnext\n");
  EXPECT_EQ(take_all(reader), (std::vector<std::string>{"line #3", "bad chunk"}));
}

}  // namespace
}  // namespace sculpt::proto
