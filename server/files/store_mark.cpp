#include "server/files/store_mark.hpp"

#include <fcntl.h>
#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <iterator>
#include <sstream>

#include "proto/crc32.hpp"
#include "server/files/durable.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

std::string line_of(const Mark& mark) {
  const std::string said = fmt::format("sculptd-mark 1 store {} changes {:020}", mark.store, mark.changes);
  return said + " check " + proto::crc32_hex(said) + "\n";
}

std::optional<Mark> read_line(const std::string& line) {
  std::istringstream words(line);
  std::string name, version, store_word, changes_word, changes;
  Mark mark;
  words >> name >> version >> store_word >> mark.store >> changes_word >> changes;
  const auto [end, error] = std::from_chars(changes.data(), changes.data() + changes.size(), mark.changes);
  if (error != std::errc() || line != line_of(mark)) return std::nullopt;
  return mark;
}

}  // namespace

std::optional<Mark> read_mark(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in && !fs::exists(fs::symlink_status(file))) return std::nullopt;
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const std::size_t half = text.size() / 2;
  std::optional<Mark> newest;
  for (const std::string& line : {text.substr(0, half), text.substr(half)}) {
    const std::optional<Mark> mark = read_line(line);
    if (mark && (!newest || newest->changes < mark->changes)) newest = mark;
  }
  if (newest) return newest;
  throw StoreLost(
      "the file '" + file.string() + "' cannot be read, so nobody knows whether the database beside it is whole",
      restore_or_adopt);
}

void write_mark(const fs::path& file, const Mark& mark) {
  write_durably(file, line_of(mark) + line_of(mark));
}

MarkFile::MarkFile(const fs::path& file, const std::string& store) : store_(store) {
  if (!fs::exists(file)) write_mark(file, {store, 0});
  file_ = ::open(file.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW);
  if (file_ < 0) fail_to_store(errno, "cannot write '" + file.string() + "'");
}

MarkFile::~MarkFile() {
  ::close(file_);
}

void MarkFile::raise(std::uint64_t changes) {
  const std::string line = line_of({store_, changes});
  const ssize_t written = ::pwrite(file_, line.data(), line.size(), next_line_ * static_cast<off_t>(line.size()));
  if (written == static_cast<ssize_t>(line.size())) next_line_ = 1 - next_line_;
}

}  // namespace sculpt::server
