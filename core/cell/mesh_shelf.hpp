// The mesh files that a URDF names.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "core/base/frame.hpp"
#include "core/mesh/mesh.hpp"

namespace sculpt {

/// No body of a machine is longer: where one is, lengths are written in millimetres.
constexpr double max_body_m = 100;

/// Loads each mesh reference once per scale.
class MeshShelf {
 public:
  /// `read_file` gives the bytes of a reference; it must outlive the object.
  explicit MeshShelf(const std::function<std::string(const std::string&)>& read_file) : read_file_(read_file) {}

  /// `owner`: who names it, for messages. Throws InputError: `urdf_invalid` for a scale that is none, an address on the
  /// network, and a mesh of more than max_body_m; `mesh_unreadable` and the others of load_mesh.
  std::shared_ptr<const Mesh> get(const std::string& reference, const Vec3& scale, const std::string& owner);

 private:
  Mesh load(const std::string& reference, const std::string& owner) const;

  const std::function<std::string(const std::string&)>& read_file_;
  std::map<std::pair<std::string, std::array<double, 3>>, std::shared_ptr<const Mesh>> meshes_;
};

}  // namespace sculpt
