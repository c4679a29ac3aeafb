// FixedMesh -> Surface: facets turned so that the sign of a crossing says whether it goes in or out.
#pragma once

#include "core/solid/fixed_mesh.hpp"

namespace sculpt {

/// What a facet bounds.
enum class Role : std::uint8_t {
  solid,
  cavity,
  doubtful_solid,   ///< of a shell that lies in one turned as it is, or that was turned the other way than most
  doubtful_cavity,  ///< of a cavity in a cavity
  unturned,         ///< nothing says which side is in: only even and odd can tell
};
constexpr std::size_t roles = 5;

struct Surface {
  FixedMesh mesh;
  std::vector<Role> role;   ///< of each facet
  std::vector<bool> sheet;  ///< facets of shells that are far from closed: turned as in the file
};

/// Facets that are there twice are one (halve_twins). Facets joined by edges of two facets are a shell. Within a shell
/// all are turned as most of them are; an outermost shell is turned outwards; one that lies wholly in another is a
/// cavity if the file turns it against that one, and a solid in a solid if not. Shells that are far from closed are
/// taken together. Deterministic.
Surface turn_shells(FixedMesh mesh);

}  // namespace sculpt
