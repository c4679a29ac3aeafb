// What the replayed parts of a motion say about it. Internal to verify/.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "core/base/frame.hpp"

namespace sculpt {

/// A straight motion in joint space: from + t * step, t in [0, 1].
struct JointMotion {
  JointMotion(Configuration the_from, Configuration the_to)
      : from(std::move(the_from)), to(std::move(the_to)), step(to - from) {}

  Configuration at(double t) const { return t == 1 ? to : Configuration(from + t * step); }

  Configuration from, to, step;
};

/// Called with what touches what (or is too close to prove that it does not) and the part t of the motion where it
/// does.
using OnContact = std::function<void(const std::string& what, double t)>;

}  // namespace sculpt
