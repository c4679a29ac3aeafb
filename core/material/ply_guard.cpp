#include "core/material/ply_guard.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <vector>

#include "core/base/error.hpp"

namespace sculpt {
namespace {

using Words = std::vector<std::string_view>;

constexpr std::array<std::string_view, 16> number_types{"char",  "uchar",  "short",   "ushort", "int",   "uint",
                                                        "float", "double", "int8",    "uint8",  "int16", "uint16",
                                                        "int32", "uint32", "float32", "float64"};

[[noreturn]] void refuse(const std::string& why) {
  throw InputError("mesh_unreadable", "the .ply file " + why + ": export it again as binary STL");
}

Words split(std::string_view line) {
  Words words;
  while (true) {
    line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
    if (line.empty()) return words;
    const std::size_t end = std::min(line.find(' '), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

bool is_number_type(std::string_view word) {
  return std::ranges::find(number_types, word) != number_types.end();
}

bool is_property(const Words& words) {
  if (words.size() == 3) return is_number_type(words[1]);
  return words.size() == 5 && words[1] == "list" && is_number_type(words[2]) && is_number_type(words[3]);
}

bool is_element(const Words& words, std::uint64_t file_bytes) {
  std::uint64_t count = 0;
  if (words.size() != 3) return false;
  const auto [end, error] = std::from_chars(words[2].data(), words[2].data() + words[2].size(), count);
  return error == std::errc{} && end == words[2].data() + words[2].size() && count <= file_bytes;
}

bool is_ascii(char c) {
  return c >= ' ' && c <= '~';
}

/// A line behind the first two. Comments may be of any text.
bool is_header_line(std::string_view line, std::uint64_t file_bytes) {
  const Words words = split(line);
  if (words.empty()) return false;
  if (words[0] == "comment" || words[0] == "obj_info") return true;
  if (!std::ranges::all_of(line, is_ascii)) return false;
  if (words[0] == "element") return is_element(words, file_bytes);
  return words[0] == "property" && is_property(words);
}

/// Takes the first line off; without its end, which is one of \n, \r\n and \r.
std::string_view take_line(std::string_view& rest) {
  const std::size_t end = rest.find_first_of("\r\n");
  if (end == std::string_view::npos) refuse("has no end of its header");
  const std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end + (rest.substr(end).starts_with("\r\n") ? 2 : 1));
  const auto is_control = [](char c) { return (c >= '\0' && c < ' ' && c != '\t') || c == '\x7f'; };
  if (std::ranges::any_of(line, is_control)) refuse("has bytes in its header that are no text");
  return line;
}

}  // namespace

void check_ply(std::string_view bytes, const std::string& extension) {
  if (extension != "ply") return;
  std::string_view rest = bytes;
  if (take_line(rest) != "ply") refuse("does not begin with \"ply\"");
  const Words format = split(take_line(rest));
  if (format.size() != 3 || format[0] != "format" || format[2] != "1.0") refuse("has no line with its format");
  for (std::string_view line = take_line(rest); line != "end_header"; line = take_line(rest)) {
    if (!is_header_line(line, bytes.size()))
      refuse("has a line in its header that cannot be used, \"" + std::string(line.substr(0, 80)) + "\"");
  }
}

}  // namespace sculpt
