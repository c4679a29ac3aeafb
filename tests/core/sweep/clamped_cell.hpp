// A cell in which something that turns with the stock stands in the tool's way.
#pragma once

#include <stdexcept>

#include "core/cell/cell.hpp"

namespace sculpt {

/// The shipped arm with a clamp on its table: a post close to one side of the stock, taller than it, and a bar from
/// there over a part of its top, 4 mm above it. Three of the five tool directions meet it somewhere.
inline CellFiles clamped_cell() {
  CellFiles files = read_cell_files(SOURCE_DIR "/config/cells/panda-turntable.json");
  std::string& urdf = files.files.at("../robots/panda-turntable.urdf");
  const std::size_t end = urdf.rfind("</robot>");
  if (end == std::string::npos) throw std::logic_error("the shipped URDF does not end as it should");
  urdf.insert(end, R"(
    <link name="clamp_post">
      <collision><origin xyz="0.125 0.06 0.115"/><geometry><box size="0.03 0.03 0.23"/></geometry></collision>
      <collision><origin xyz="0.105 0.06 0.217"/><geometry><box size="0.07 0.03 0.026"/></geometry></collision>
    </link>
    <joint name="clamp_screw" type="fixed"><parent link="stock"/><child link="clamp_post"/></joint>
  )");
  return files;
}

}  // namespace sculpt
