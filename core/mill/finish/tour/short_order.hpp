// In which order arcs are gone along, and from which end, so that ways between them are short.
#pragma once

#include <cstdint>
#include <vector>

#include "core/mill/finish/envelope.hpp"

namespace sculpt {

/// Of each place in the order the end where its arc begins: 2 a is the front of arc a, 2 a + 1 its back. The nearest
/// next, then made better by 2-opt and Or-opt over the nearest neighbours of each end (Bentley, "Fast algorithms for
/// geometric traveling salesman problems", ORSA J. Computing 4, 1992), again and again after a small part of the order
/// was mixed up (Johnson, McGeoch, "The traveling salesman problem: a case study in local optimization", 1997: iterated
/// local search with segment lengths of 50). There must be an arc.
std::vector<std::uint32_t> short_order(const std::vector<Contour>& arcs);

}  // namespace sculpt
