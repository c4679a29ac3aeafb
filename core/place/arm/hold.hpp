// What an arm makes of a place of the ball.
#pragma once

#include <cstdint>

namespace sculpt {

/// What the arm makes of a sector along a direction, best first: it holds the ball there; it would, but a link touches
/// the full block; or room, robot or tool; or only past joint limits; or not at all.
enum class Hold : std::uint8_t { held, stock, links, limits, reach };

}  // namespace sculpt
