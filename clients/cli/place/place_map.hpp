// What `sculpt place` found, as a picture: a map of x and y for each height, turn and tool.
#pragma once

#include <string>

#include "clients/cli/place/place_report.hpp"

namespace sculpt::cli {

/// An SVG document. Of more than 24 maps the best; the cell's own stand has a frame, the
/// best one a dashed one. Colours say how much is left, in
/// steps of a factor, so that 99.0 and 99.9 % can be told apart.
std::string place_map_svg(const PlaceReport& report);

}  // namespace sculpt::cli
