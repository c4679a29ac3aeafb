// The header of a .ply file: what its body holds, and in which form.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sculpt {

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

constexpr std::size_t size_of(PlyType type) {
  constexpr std::size_t sizes[]{1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

struct PlyProperty {
  std::string name;
  PlyType type;
  std::optional<PlyType> length{};  ///< of a list: the type of its length
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties{};
};

struct PlyHeader {
  enum class Form { ascii, little_endian, big_endian };
  Form form = Form::ascii;
  std::vector<PlyElement> elements;
  std::size_t body = 0;   ///< byte of the file at which the body begins
  std::size_t lines = 0;  ///< of the header
};

/// Throws InputError `mesh_unreadable` for a header that is not as the format says (Turk, "The PLY Polygon File
/// Format"), and for more elements than the body has bytes for.
PlyHeader read_ply_header(std::string_view bytes);

/// Throws InputError `mesh_unreadable`: "the .ply file " + `why`, and what to do.
[[noreturn]] void refuse_ply(const std::string& why);

}  // namespace sculpt
