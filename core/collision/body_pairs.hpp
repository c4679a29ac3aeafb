// Links that are kept apart -> the bodies that are, and by how much.
#pragma once

#include <cstddef>
#include <vector>

#include "core/collision/link_pairs.hpp"
#include "core/collision/shape/body.hpp"

namespace sculpt {

/// Two bodies, by number, of which no shapes come nearer to each other than `margin_m`.
struct BodyPair {
  std::size_t first, second;
  double margin_m;
};

/// `first` and `second`: the numbers of the bodies of the two links. Where not all of their shapes are kept apart, the
/// bodies that are parts of them are added to `bodies`. The margin is link_margin_m, or where the two are nearer to
/// each other at home a share of that gap.
std::vector<BodyPair> pair_bodies(std::vector<Body>& bodies, std::size_t first, std::size_t second,
                                  const CheckedLinks& checked);

}  // namespace sculpt
