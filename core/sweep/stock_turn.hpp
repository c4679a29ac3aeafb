// Does a joint turn the stock under the arm so that a quarter turn changes nothing but the side that is in front?
#pragma once

#include <memory>
#include <optional>

#include "core/cell/chain.hpp"
#include "core/solid/placement.hpp"
#include "core/sweep/field/posture_field.hpp"

namespace sculpt {

/// A joint whose axis stands upright in the middle of the grid, with nothing on the stock's side of it that a quarter
/// turn would move: plates and posts that are round or square about that axis, no more.
struct StockTurn {
  int coordinate;
  double direction;  ///< 1 or -1: which way the tool goes around the stock, seen from above, as the coordinate grows
};

/// Nothing if there is none. `grid` in the frame of the chain's stock link.
std::optional<StockTurn> find_stock_turn(const Chain& chain, const Grid& grid);

/// The field for `view`, its own turned by so many quarters. Nothing if the joint does not turn so far.
std::unique_ptr<PostureField> turned(const PostureField& field, const StockTurn& turn, const ToolView& view,
                                     int quarters);

}  // namespace sculpt
