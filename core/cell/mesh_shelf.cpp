#include "core/cell/mesh_shelf.hpp"

#include "core/base/error.hpp"
#include "core/base/extension.hpp"
#include "core/base/watch.hpp"
#include "core/mesh/mesh_file.hpp"

namespace sculpt {
namespace {

constexpr std::uint64_t mesh_memory_cap_bytes = 1ull << 30;

}  // namespace

std::shared_ptr<const Mesh> MeshShelf::get(const std::string& reference, const Vec3& scale, const std::string& owner) {
  if (!scale.allFinite() || (scale.array() == 0).any()) {
    throw InputError("urdf_invalid", "the scale of mesh '" + reference + "' of " + owner + " must be finite and not 0");
  }
  auto& kept = meshes_[{reference, {scale.x(), scale.y(), scale.z()}}];
  if (kept) return kept;
  auto mesh = std::make_shared<Mesh>(load(reference, owner));
  for (Vec3& vertex : mesh->vertices) vertex = vertex.cwiseProduct(scale);
  if (scale.prod() < 0) {
    for (auto& triangle : mesh->triangles) std::swap(triangle[1], triangle[2]);
  }
  kept = std::move(mesh);
  return kept;
}

Mesh MeshShelf::load(const std::string& reference, const std::string& owner) const {
  const std::string extension = extension_of(reference), named = "mesh '" + reference + "' of " + owner;
  const std::string bytes = read_file_(reference);
  try {
    return load_mesh(bytes, extension, mesh_memory_cap_bytes, Watch{});
  } catch (const InputError& error) {
    throw InputError(error.code(), named + ": " + error.what());
  }
}

}  // namespace sculpt
