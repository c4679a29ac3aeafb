// A configuration drawn uniformly from within the joint limits.
#pragma once

#include "core/base/random.hpp"
#include "core/cell/chain.hpp"

namespace sculpt {

inline Configuration random_configuration(const Chain& chain, Random& random) {
  Configuration q(chain.dof());
  for (int i = 0; i < chain.dof(); ++i) q[i] = random.between(chain.lower()[i], chain.upper()[i]);
  return q;
}

}  // namespace sculpt
