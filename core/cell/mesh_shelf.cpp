#include "core/cell/mesh_shelf.hpp"

#include <Eigen/Geometry>
#include <sstream>

#include "core/base/error.hpp"
#include "core/base/extension.hpp"
#include "core/base/watch.hpp"
#include "core/mesh/mesh_file.hpp"

namespace sculpt {
namespace {

constexpr std::uint64_t mesh_memory_cap_bytes = 1ull << 30;

void require_size(const Mesh& mesh, const std::string& reference, const std::string& owner) {
  Eigen::AlignedBox3d box;
  for (const Vec3& vertex : mesh.vertices) box.extend(vertex);
  if (mesh.vertices.empty() || box.sizes().maxCoeff() <= max_body_m) return;
  std::ostringstream text;
  text << "mesh '" << reference << "' of " << owner << " is " << box.sizes().maxCoeff()
       << " m long in its scale, at most " << max_body_m
       << " m are a body of a machine: if it is drawn in millimetres, give it scale=\"0.001 0.001 0.001\"";
  throw InputError("urdf_invalid", text.str());
}

}  // namespace

std::shared_ptr<const Mesh> MeshShelf::get(const std::string& reference, const Vec3& scale, const std::string& owner) {
  if (!scale.allFinite() || (scale.array() == 0).any()) {
    throw InputError("urdf_invalid", "the scale of mesh '" + reference + "' of " + owner + " must be finite and not 0");
  }
  auto& kept = meshes_[{reference, {scale.x(), scale.y(), scale.z()}}];
  if (kept) return kept;
  auto mesh = std::make_shared<Mesh>(load(reference, owner));
  for (Vec3& vertex : mesh->vertices) vertex = vertex.cwiseProduct(scale);
  require_size(*mesh, reference, owner);
  if (scale.prod() < 0) {
    for (auto& triangle : mesh->triangles) std::swap(triangle[1], triangle[2]);
  }
  kept = std::move(mesh);
  return kept;
}

Mesh MeshShelf::load(const std::string& reference, const std::string& owner) const {
  const std::string extension = extension_of(reference), named = "mesh '" + reference + "' of " + owner;
  if (reference.starts_with("http://") || reference.starts_with("https://"))
    throw InputError("urdf_invalid", named +
                                         " lies on the network, where nothing is read from: save it beside the "
                                         "URDF, and name it by its path");
  const std::string bytes = read_file_(reference);
  try {
    return load_mesh(bytes, extension, mesh_memory_cap_bytes, Watch{});
  } catch (const InputError& error) {
    throw InputError(error.code(), named + ": " + error.what());
  }
}

}  // namespace sculpt
