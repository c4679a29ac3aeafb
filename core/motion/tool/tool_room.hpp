// The room that a tool needs at a voxel, whatever arm holds it.
#pragma once

#include <vector>

#include "core/collision/scene.hpp"
#include "core/collision/shape/body.hpp"

namespace sculpt {

/// Ball, shank and holder; robot and spindle do not count. Reads from several threads are safe. Refers to the scene.
class ToolRoom {
 public:
  explicit ToolRoom(const Scene& scene);

  /// Does the tool stand clear of `material`, but for `voxel`, with the ball at its centre and the shank along `axis`
  /// (unit vector, stock frame)?
  bool is_free(const Material& material, Voxel voxel, const Vec3& axis) const;

 private:
  const Grid& grid_;
  const Tool& tool_;
  std::vector<Body> holder_;
};

}  // namespace sculpt
