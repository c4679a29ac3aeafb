#include "core/mesh/off.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/mesh/polygon.hpp"

namespace sculpt {
namespace {

/// Lines of a text, without comments and empty ones, word by word.
class Lines {
 public:
  explicit Lines(std::string_view bytes) : bytes_(bytes) {}

  void go_on() {
    do {
      if (at_ >= bytes_.size()) refuse("ends before it is complete");
      const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
      line_ = bytes_.substr(at_, end - at_);
      line_ = line_.substr(0, line_.find('#'));
      at_ = end + 1;
      ++number_;
    } while (line_.find_first_not_of(blanks) == std::string_view::npos);
  }

  bool at_end() const { return line_.find_first_not_of(blanks) == std::string_view::npos; }

  std::string_view word() {
    line_.remove_prefix(std::min(line_.find_first_not_of(blanks), line_.size()));
    const std::string_view word = line_.substr(0, line_.find_first_of(blanks));
    line_.remove_prefix(word.size());
    return word;
  }

  double number() {
    const std::string_view text = word();
    if (text.empty()) refuse("has too few numbers");
    const std::optional<double> value = parse_coordinate(text);
    if (!value) refuse("has a word that is no number, \"" + std::string(text.substr(0, 40)) + "\"");
    return *value;
  }

  /// A whole number below `end`, which is `what`.
  std::uint64_t whole_number(std::uint64_t end, const std::string& what) {
    const double value = number();
    if (!(value >= 0 && value < static_cast<double>(end)) || value != std::floor(value))
      refuse("has a number that cannot be: it must be whole, and below the " + what + ", " + std::to_string(end));
    return static_cast<std::uint64_t>(value);
  }

  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError("mesh_unreadable",
                     "the .off file " + why + " (line " + std::to_string(number_) + "): export it again as binary STL");
  }

 private:
  static constexpr std::string_view blanks = " \t\r";
  std::string_view bytes_, line_;
  std::size_t at_ = 0, number_ = 0;
};

/// The word "OFF" with what comes before it: texture coordinates ST, colours C, normals N; they follow the coordinates.
void read_first_word(Lines& lines) {
  lines.go_on();
  std::string_view word = lines.word();
  for (const std::string_view before : {"ST", "C", "N"})
    if (word.starts_with(before)) word.remove_prefix(before.size());
  if (word != "OFF") lines.refuse("does not begin with \"OFF\", \"COFF\", \"NOFF\" or the like");
  if (lines.at_end()) lines.go_on();
}

}  // namespace

Mesh read_off(std::string_view bytes) {
  Lines lines(bytes);
  read_first_word(lines);
  // A vertex takes 6 bytes at least, three digits with what ends them, and a face 2.
  const std::uint64_t vertices = lines.whole_number(bytes.size() / 6 + 1, "vertices that its bytes can hold");
  const std::uint64_t faces = lines.whole_number(bytes.size() / 2 + 1, "faces that its bytes can hold");
  Mesh mesh;
  mesh.vertices.reserve(vertices);
  for (std::uint64_t v = 0; v < vertices; ++v) {
    lines.go_on();
    const double x = lines.number(), y = lines.number(), z = lines.number();
    mesh.vertices.emplace_back(x, y, z);
  }
  std::vector<std::uint32_t> corners;
  for (std::uint64_t f = 0; f < faces; ++f) {
    lines.go_on();
    corners.resize(lines.whole_number(bytes.size() / 2, "corners that its bytes can hold"));
    for (std::uint32_t& corner : corners)
      corner = static_cast<std::uint32_t>(lines.whole_number(vertices, "number of vertices"));
    add_polygon(corners, mesh);
  }
  return mesh;
}

}  // namespace sculpt
