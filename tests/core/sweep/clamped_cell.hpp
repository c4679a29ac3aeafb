// A cell in which something that turns with the stock stands in the tool's way.
#pragma once

#include <stdexcept>
#include <string>

#include "core/cell/cell.hpp"

namespace sculpt {

/// The shipped arm with something on its table that turns with the stock: `bodies` as a URDF has them, in the frame of
/// the stock's bottom (the stock is a cube of 0.2 m around its z axis).
inline CellFiles cell_with(const std::string& bodies) {
  CellFiles files = read_cell_files(SOURCE_DIR "/config/cells/panda-turntable.json");
  std::string& urdf = files.files.at("../robots/panda-turntable.urdf");
  const std::size_t end = urdf.rfind("</robot>");
  if (end == std::string::npos) throw std::logic_error("the shipped URDF does not end as it should");
  urdf.insert(end, "<link name=\"clamp_body\">" + bodies +
                       "</link><joint name=\"clamp_screw\" type=\"fixed\"><parent link=\"stock\"/>"
                       "<child link=\"clamp_body\"/></joint>");
  return files;
}

/// A post close to one side of the stock, taller than it, and a bar from there over a part of its top, 4 mm above it.
/// Three of the five tool directions meet it somewhere.
inline CellFiles clamped_cell() {
  return cell_with(R"(
    <collision><origin xyz="0.125 0.06 0.115"/><geometry><box size="0.03 0.03 0.23"/></geometry></collision>
    <collision><origin xyz="0.105 0.06 0.217"/><geometry><box size="0.07 0.03 0.026"/></geometry></collision>
  )");
}

/// A thin pin that ends in the air above the stock, off its middle.
inline CellFiles cell_with_pin() {
  return cell_with(R"(
    <collision><origin xyz="0 0.05 0.216"/><geometry><box size="0.02 0.001 0.03"/></geometry></collision>
  )");
}

}  // namespace sculpt
