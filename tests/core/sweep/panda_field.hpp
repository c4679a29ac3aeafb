// The field of the shipped arm for one tool direction at 16, for tests.
#pragma once

#include <stdexcept>

#include "core/cell/ik.hpp"
#include "core/sweep/field/posture_field.hpp"

namespace sculpt {

/// From above the middle of the stock, as near to home as the arm comes there.
inline PostureField make_field(const Scene& scene, const Configuration& home, const ToolView& view) {
  const auto start = solve_ik(
      scene.chain(), {view.ball_m(scene.grid(), {view.n / 2.0, view.n / 2.0, view.n + 1.0}), view.axis()}, home);
  if (!start) throw std::logic_error("the arm does not come to where the field should begin");
  return {scene, view, PostureLattice::Start{*start}, 1, {}};
}

/// Of tool direction +z, made once a process.
class PandaField {
 public:
  static const PandaField& get() {
    static const PandaField made;
    return made;
  }
  const Cell cell;
  const Grid grid;
  /// Holds the full stock.
  const Scene scene;
  const PostureField field;

 private:
  PandaField()
      : cell(parse_cell(read_cell_files(SOURCE_DIR "/config/cells/panda-turntable.json"))),
        grid(cell.grid(16)),
        scene(cell, grid, VoxelSet(16, true)),
        field(make_field(scene, cell.home(scene.chain()), tool_views(16)[0])) {}
};

}  // namespace sculpt
