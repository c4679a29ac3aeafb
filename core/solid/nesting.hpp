// Which shell lies in which.
#pragma once

#include "core/solid/fixed_mesh.hpp"

namespace sculpt {

/// Facets that bound something together.
struct Shell {
  std::vector<std::uint32_t> facets;
  Eigen::AlignedBox3d box;
  double volume = 0;    ///< signed, units cubed: above 0 where the facets are turned outwards
  bool is_body = true;  ///< closed, or nearly so: only such a shell can lie in another
};

/// For each shell the smallest one that it lies wholly in, or -1. Looked at in a few points of it; only the 1000
/// largest shells are thought to hold others. `shell_of`: of each facet.
std::vector<int> find_nesting(const FixedMesh& mesh, const std::vector<Shell>& shells,
                              const std::vector<std::uint32_t>& shell_of);

}  // namespace sculpt
