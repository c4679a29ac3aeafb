// A mesh file, and what is inside it; the first byte says of which kind it claims to be.
#include "core/mesh/mesh.hpp"

#include <array>

#include "core/base/error.hpp"
#include "core/mesh/mesh_file.hpp"
#include "core/solid/placement.hpp"
#include "core/solid/voxelize.hpp"
#include "tests/fuzz/target.hpp"

void read_hostile(std::string_view bytes) {
  if (bytes.empty()) return;
  constexpr std::array kinds{"stl", "obj", "ply", "gltf", "glb", "off"};
  constexpr std::uint64_t memory_cap_bytes = 256u << 20;
  const char* kind = bytes.front() == 'd' ? "dae" : kinds[static_cast<std::uint8_t>(bytes.front()) % kinds.size()];
  try {
    const sculpt::Mesh mesh = sculpt::load_mesh(bytes.substr(1), kind, memory_cap_bytes, {});
    const sculpt::Grid grid{8, 1, sculpt::Vec3::Zero()};
    sculpt::find_solid(sculpt::place_mesh(mesh, {}, grid), grid, {});
  } catch (const sculpt::InputError&) {
  }
}
