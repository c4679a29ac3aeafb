// Pencil passes: along creases, through just the places that a ball is to come to.
#pragma once

#include <vector>

#include "core/mill/finish/rows.hpp"

namespace sculpt {

/// Places that are no farther apart than `link_m` are joined to chains, from each to the nearest that is left; where
/// there is none the row is as long as `short_m`. `middles`: tool frame, m.
std::vector<Row> pencil_rows(const std::vector<Vec3>& middles, double link_m, double short_m);

}  // namespace sculpt
