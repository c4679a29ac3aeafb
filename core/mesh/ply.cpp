#include "core/mesh/ply.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "core/base/error.hpp"
#include "core/mesh/ply_header.hpp"
#include "core/mesh/polygon.hpp"

namespace sculpt {
namespace {

template <typename T>
double to_double(const char* bytes, bool swapped) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), bytes, sizeof(T));
  if (swapped) std::reverse(raw.begin(), raw.end());
  return static_cast<double>(std::bit_cast<T>(raw));
}

/// The numbers of the body, one after the other.
class Body {
 public:
  Body(std::string_view bytes, const PlyHeader& header)
      : bytes_(bytes), at_(header.body), form_(header.form), first_line_(header.lines + 1), begin_(header.body) {}

  bool is_text() const { return form_ == PlyHeader::Form::ascii; }
  std::uint64_t bytes_left() const { return bytes_.size() - at_; }

  /// The element that is read now, for messages.
  void enter(const PlyElement& element, std::uint64_t number) {
    element_ = &element;
    number_ = number;
    begin_of_element_ = at_;
  }

  double take(PlyType type) { return is_text() ? take_word() : take_bytes(type); }

  /// The length of a list of `type`, no longer than the rest of the file.
  std::uint64_t take_length(PlyType length_type, PlyType type) {
    const double length = take(length_type);
    const auto most = static_cast<double>(is_text() ? (bytes_left() + 1) / 2 : bytes_left() / size_of(type));
    if (!(length >= 0 && length <= most) || length != std::floor(length))
      refuse("has a list whose length cannot be, " + text_of(length));
    return static_cast<std::uint64_t>(length);
  }

  [[noreturn]] void refuse(const std::string& why) const {
    const auto begin = bytes_.begin() + static_cast<std::ptrdiff_t>(begin_);
    const auto lines = std::count(begin, bytes_.begin() + static_cast<std::ptrdiff_t>(begin_of_element_), '\n');
    refuse_ply("cannot be read: " + element_->name + " " + std::to_string(number_) + " (" +
               (is_text() ? "line " + std::to_string(first_line_ + static_cast<std::size_t>(lines))
                          : "byte " + std::to_string(begin_of_element_)) +
               ") " + why);
  }

  static std::string text_of(double value) {
    return value == std::floor(value) && std::abs(value) < 1e15 ? std::to_string(static_cast<std::int64_t>(value))
                                                                : std::to_string(value);
  }

 private:
  double take_word() {
    constexpr std::string_view blanks = " \t\r\n";
    const std::size_t first = bytes_.find_first_not_of(blanks, at_);
    if (first == std::string_view::npos) refuse("is missing: the file ends before it is complete");
    const std::size_t end = std::min(bytes_.find_first_of(blanks, first), bytes_.size());
    if (at_ == begin_of_element_) begin_of_element_ = first;
    at_ = end;
    const std::string_view word = bytes_.substr(first, end - first);
    const std::optional<double> value = parse_coordinate(word);
    if (!value) refuse("has a word that is no number, \"" + std::string(word.substr(0, 40)) + "\"");
    return *value;
  }

  double take_bytes(PlyType type) {
    if (bytes_left() < size_of(type)) refuse("is missing: the file ends before it is complete");
    const char* from = bytes_.data() + at_;
    at_ += size_of(type);
    const bool swapped = (form_ == PlyHeader::Form::big_endian) == (std::endian::native == std::endian::little);
    switch (type) {
      case PlyType::int8:
        return to_double<std::int8_t>(from, swapped);
      case PlyType::uint8:
        return to_double<std::uint8_t>(from, swapped);
      case PlyType::int16:
        return to_double<std::int16_t>(from, swapped);
      case PlyType::uint16:
        return to_double<std::uint16_t>(from, swapped);
      case PlyType::int32:
        return to_double<std::int32_t>(from, swapped);
      case PlyType::uint32:
        return to_double<std::uint32_t>(from, swapped);
      case PlyType::float32:
        return to_double<float>(from, swapped);
      case PlyType::float64:
        return to_double<double>(from, swapped);
    }
    return 0;
  }

  std::string_view bytes_;
  std::size_t at_;
  PlyHeader::Form form_;
  std::size_t first_line_, begin_;  ///< of the body
  const PlyElement* element_ = nullptr;
  std::uint64_t number_ = 0;
  std::size_t begin_of_element_ = 0;
};

class Reader {
 public:
  Reader(const PlyHeader& header, std::string_view bytes, std::uint64_t memory_cap_bytes)
      : header_(header), body_(bytes, header), max_triangles_(memory_cap_bytes / (3 * sizeof(Mesh::triangles[0]))) {}

  Mesh read() {
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty()) continue;
      const auto read_one = element.name == "vertex" ? &Reader::read_vertex : &Reader::read_other;
      if (element.name == "vertex") mesh_.vertices.reserve(element.count);
      for (std::uint64_t number = 0; number < element.count; ++number) {
        body_.enter(element, number);
        (this->*read_one)(element);
      }
    }
    return std::move(mesh_);
  }

 private:
  void read_vertex(const PlyElement& element) {
    Vec3 at = Vec3::Zero();
    int found = 0;
    for (const PlyProperty& property : element.properties) {
      if (property.length) {
        skip_list(property);
        continue;
      }
      const double value = body_.take(property.type);
      for (int axis = 0; axis < 3; ++axis)
        if (property.name == std::string_view("xyz").substr(static_cast<std::size_t>(axis), 1)) {
          at[axis] = value;
          ++found;
        }
    }
    if (found != 3) body_.refuse("has not one x, one y and one z");
    mesh_.vertices.push_back(at);
  }

  void read_other(const PlyElement& element) {
    const bool is_face = element.name == "face", is_strip = element.name == "tristrips";
    for (const PlyProperty& property : element.properties) {
      const bool is_corners = property.name == "vertex_indices" || property.name == "vertex_index";
      if (!property.length) {
        body_.take(property.type);
      } else if (is_corners && (is_face || is_strip)) {
        read_corners(property, is_strip);
        is_strip ? add_strips() : add_polygon(corners_, mesh_);
        if (mesh_.triangles.size() > max_triangles_)
          throw InputError("memory_cap",
                           "the triangles of the .ply file do not fit into the memory cap: raise it, or "
                           "reduce the mesh to fewer triangles");
      } else {
        skip_list(property);
      }
    }
  }

  void skip_list(const PlyProperty& property) {
    for (std::uint64_t left = body_.take_length(*property.length, property.type); left > 0; --left)
      body_.take(property.type);
  }

  /// In strips -1 ends one strip.
  void read_corners(const PlyProperty& property, bool is_strip) {
    corners_.resize(body_.take_length(*property.length, property.type));
    for (std::uint32_t& corner : corners_) {
      const double value = body_.take(property.type);
      if (is_strip && value == -1) {
        corner = strip_end;
        continue;
      }
      if (!(value >= 0 && value < static_cast<double>(mesh_.vertices.size())) || value != std::floor(value))
        body_.refuse("names vertex " + Body::text_of(value) + ", and there are " +
                     std::to_string(mesh_.vertices.size()) + " before it");
      corner = static_cast<std::uint32_t>(value);
    }
  }

  void add_strips() {
    std::size_t first = 0;
    for (std::size_t at = 0; at < corners_.size(); ++at) {
      if (corners_[at] == strip_end) first = at + 1;
      if (corners_[at] == strip_end || at < first + 2) continue;
      const bool is_turned = (at - first) % 2 != 0;
      mesh_.triangles.push_back(
          {corners_[at - 2], corners_[at - (is_turned ? 0 : 1)], corners_[at - (is_turned ? 1 : 0)]});
    }
  }

  static constexpr std::uint32_t strip_end = ~std::uint32_t{0};
  const PlyHeader& header_;
  Body body_;
  std::uint64_t max_triangles_;
  std::vector<std::uint32_t> corners_;
  Mesh mesh_;
};

}  // namespace

Mesh read_ply(std::string_view bytes, std::uint64_t memory_cap_bytes) {
  const PlyHeader header = read_ply_header(bytes);
  return Reader(header, bytes, memory_cap_bytes).read();
}

}  // namespace sculpt
