#include "server/files/zip_writer.hpp"

#include <archive.h>
#include <archive_entry.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>
#include <map>
#include <sstream>

#include "core/base/random.hpp"

namespace sculpt::server {
namespace {

using Texts = std::vector<std::pair<std::string, std::string>>;

std::string packed(const Texts& texts) {
  std::ostringstream out;
  ZipWriter zip(out);
  for (const auto& [path, text] : texts) zip.add(path, text);
  zip.finish();
  return out.str();
}

Texts unpacked(const std::string& bytes) {
  Texts texts;
  archive* in = archive_read_new();
  archive_read_support_format_zip(in);
  EXPECT_EQ(archive_read_open_memory(in, bytes.data(), bytes.size()), ARCHIVE_OK);
  archive_entry* entry = nullptr;
  while (archive_read_next_header(in, &entry) == ARCHIVE_OK) {
    std::string text;
    std::vector<char> piece(1 << 16);
    for (la_ssize_t got = 1; got > 0;) {
      got = archive_read_data(in, piece.data(), piece.size());
      EXPECT_GE(got, 0) << archive_error_string(in);
      if (got > 0) text.append(piece.data(), static_cast<std::size_t>(got));
    }
    texts.emplace_back(archive_entry_pathname(entry), std::move(text));
  }
  archive_read_free(in);
  return texts;
}

const Texts some{{"bust/bust_0001.src", "DEF bust_0001()\r\nEND\r\n"}, {"bust/bust.src", ""}};

TEST(ZipWriter, GivesBackWhatWentInInItsOrder) {
  Random random(7);
  Texts texts = some;
  for (const std::size_t size : {1u, 65535u, 65536u, 500000u}) {
    std::string noise(size, '\0');
    for (char& byte : noise) byte = static_cast<char>(random.next());
    texts.emplace_back("bust/" + std::to_string(size), std::move(noise));
  }
  EXPECT_EQ(unpacked(packed(texts)), texts);
  EXPECT_LT(packed({{"a", std::string(500000, 'x')}}).size(), 2000u);
}

TEST(ZipWriter, BytesHangOnNeitherClockNorPlace) {
  const std::string bytes = packed(some);
  EXPECT_EQ(bytes.substr(0, 4), "PK\x03\x04");
  EXPECT_EQ(bytes.substr(10, 4), std::string("\0\0\x21\0", 4)) << "midnight of the first day that a .zip can say";
  for (const char* zone : {"Pacific/Kiritimati", "America/Los_Angeles", "UTC"}) {
    ::setenv("TZ", zone, 1);
    ::tzset();
    EXPECT_EQ(packed(some), bytes) << zone;
  }
  ::unsetenv("TZ");
  ::tzset();
}

TEST(ZipWriter, AFullDiskIsSeenByTheStream) {
  std::ostringstream out;
  out.setstate(std::ios::badbit);
  ZipWriter zip(out);
  zip.add("a", "text");
  zip.finish();
  EXPECT_FALSE(out);
}

}  // namespace
}  // namespace sculpt::server
