// Parts made for milling tests: binary STL, mm.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace sculpt::milled {

/// A square block from the origin on with one height over each place, over lines along both axes (mm, from 0 to the
/// block's side, ascending).
std::string height_field(const std::vector<double>& lines, const std::function<double(double x, double y)>& height);
/// So many squares along a side.
std::string height_field(double side_mm, int squares, const std::function<double(double x, double y)>& height);
/// Lines for upright walls at these places, and about every two millimetres besides.
std::vector<double> lines_with_steps(double side_mm, const std::vector<double>& steps);

/// Turned about z: `outline` goes up from the axis at the bottom to the axis at the top, with the solid on its left:
/// (radius, height) each.
std::string turned(const std::vector<std::array<double, 2>>& outline);

}  // namespace sculpt::milled
