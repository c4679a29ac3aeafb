// A mesh file; the first byte says of which kind it claims to be.
#include "core/material/mesh.hpp"

#include <array>

#include "core/base/error.hpp"
#include "tests/fuzz/target.hpp"

void read_hostile(std::string_view bytes) {
  if (bytes.empty()) return;
  constexpr std::array kinds{"stl", "obj", "ply", "gltf", "glb", "off"};
  constexpr std::uint64_t memory_cap_bytes = 256u << 20;
  const char* kind = kinds[static_cast<std::uint8_t>(bytes.front()) % kinds.size()];
  try {
    sculpt::load_mesh(bytes.substr(1), kind, memory_cap_bytes, {});
  } catch (const sculpt::InputError&) {
  }
}
