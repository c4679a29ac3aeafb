// What the replayed parts of a motion say about it. Internal to verify/.
#pragma once

#include <functional>
#include <string>

#include "core/base/frame.hpp"

namespace sculpt {

/// A straight motion in joint space: from + t * step, t in [0, 1].
struct JointMotion {
  Configuration from, step;
  Configuration at(double t) const { return from + t * step; }
};

/// Called with what touches what (or is too close to prove that it does not) and the part t of the motion where it
/// does.
using OnContact = std::function<void(const std::string& what, double t)>;

}  // namespace sculpt
