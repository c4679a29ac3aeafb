// A home as a cell file has it: values by the names of joints.
#pragma once

#include "core/cell/chain.hpp"
#include "core/doctor/findings.hpp"

namespace sculpt {

inline JointValues name_values(const Chain& chain, const Configuration& q) {
  JointValues values;
  const std::vector<std::string> names = chain.names();
  for (int c = 0; c < chain.dof(); ++c) values[names[static_cast<std::size_t>(c)]] = q[c];
  return values;
}

}  // namespace sculpt
