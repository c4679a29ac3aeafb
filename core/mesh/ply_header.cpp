#include "core/mesh/ply_header.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include "core/base/error.hpp"

namespace sculpt {
namespace {

using Words = std::vector<std::string_view>;

Words split(std::string_view line) {
  Words words;
  while (true) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (line.empty()) return words;
    const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

std::optional<PlyType> find_type(std::string_view word) {
  using enum PlyType;
  constexpr std::pair<std::string_view, PlyType> types[]{
      {"char", int8},   {"uchar", uint8},   {"short", int16},     {"ushort", uint16},
      {"int", int32},   {"uint", uint32},   {"float", float32},   {"double", float64},
      {"int8", int8},   {"uint8", uint8},   {"int16", int16},     {"uint16", uint16},
      {"int32", int32}, {"uint32", uint32}, {"float32", float32}, {"float64", float64}};
  const auto found = std::ranges::find(types, word, &std::pair<std::string_view, PlyType>::first);
  return found == std::end(types) ? std::nullopt : std::optional(found->second);
}

bool is_whole(std::optional<PlyType> type) {
  return type && *type != PlyType::float32 && *type != PlyType::float64;
}

/// The least number of bytes that the values of one element take in the body.
std::uint64_t min_size(const PlyElement& element, PlyHeader::Form form) {
  std::uint64_t size = 0;
  for (const PlyProperty& property : element.properties)
    size += form == PlyHeader::Form::ascii ? 2 : size_of(property.length.value_or(property.type));  // a digit, a blank
  return size;
}

class HeaderReader {
 public:
  explicit HeaderReader(std::string_view bytes) : bytes_(bytes) {}

  PlyHeader read() {
    if (take_line() != "ply") refuse_ply("does not begin with \"ply\"");
    read_form();
    for (std::string_view line = take_line(); line != "end_header"; line = take_line())
      if (!read_line(line))
        refuse_ply("has a line in its header that cannot be used, line " + std::to_string(header_.lines) + ", \"" +
                   std::string(line.substr(0, 80)) + "\"");
    header_.body = at_;
    check_counts();
    return std::move(header_);
  }

 private:
  /// The first line says whether lines end with \n, \r\n or \r.
  std::string_view take_line() {
    if (at_ == 0)
      end_ = bytes_.substr(0, std::min(bytes_.find('\n'), bytes_.size())).find('\r') == 3 &&
                     !bytes_.substr(3).starts_with("\r\n")
                 ? '\r'
                 : '\n';
    const std::size_t end = bytes_.find(end_, at_);
    if (end == std::string_view::npos) refuse_ply("has no end of its header");
    std::string_view line = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    ++header_.lines;
    if (line.ends_with('\r')) line.remove_suffix(1);
    const auto is_control = [](char c) { return (c >= '\0' && c < ' ' && c != '\t') || c == '\x7f'; };
    if (std::ranges::any_of(line, is_control)) refuse_ply("has bytes in its header that are no text");
    return line;
  }

  void read_form() {
    const Words words = split(take_line());
    using enum PlyHeader::Form;
    constexpr std::pair<std::string_view, PlyHeader::Form> forms[]{
        {"ascii", ascii}, {"binary_little_endian", little_endian}, {"binary_big_endian", big_endian}};
    if (words.size() == 3 && words[0] == "format" && words[2] == "1.0")
      for (const auto& [word, form] : forms)
        if (words[1] == word) {
          header_.form = form;
          return;
        }
    refuse_ply("has no line with its format");
  }

  bool read_line(std::string_view line) {
    const Words words = split(line);
    if (words.empty()) return false;
    if (words[0] == "comment" || words[0] == "obj_info") return true;
    if (words[0] == "element") return read_element(words);
    return words[0] == "property" && read_property(words);
  }

  bool read_element(const Words& words) {
    if (words.size() != 3) return false;
    std::uint64_t count = 0;
    const char* end = words[2].data() + words[2].size();
    const auto [read_to, error] = std::from_chars(words[2].data(), end, count);
    if (error != std::errc{} || read_to != end) return false;
    header_.elements.push_back({std::string(words[1]), count});
    return true;
  }

  bool read_property(const Words& words) {
    if (header_.elements.empty() || words.size() < 3) return false;
    auto& properties = header_.elements.back().properties;
    const bool is_list = words.size() == 5 && words[1] == "list";
    const auto type = find_type(words[is_list ? 3 : 1]), length = is_list ? find_type(words[2]) : std::nullopt;
    if (!type || (is_list ? !is_whole(length) : words.size() != 3)) return false;
    properties.push_back({std::string(words.back()), *type, length});
    return true;
  }

  void check_counts() const {
    std::uint64_t left = bytes_.size() - header_.body + 1;  // the last blank may be missing
    for (const PlyElement& element : header_.elements) {
      const std::uint64_t size = min_size(element, header_.form);
      if (size == 0 ? element.count > 0 : element.count > left / size)
        refuse_ply("says that it has " + std::to_string(element.count) + " of element " + element.name +
                   ", more than its " + std::to_string(bytes_.size()) + " bytes can hold");
      left -= size * element.count;
    }
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
  char end_ = '\n';
  PlyHeader header_;
};

}  // namespace

PlyHeader read_ply_header(std::string_view bytes) {
  return HeaderReader(bytes).read();
}

void refuse_ply(const std::string& why) {
  throw InputError("mesh_unreadable", "the .ply file " + why + ": export it again as binary STL");
}

}  // namespace sculpt
