// A robot that holds D6, and its fields of postures.
#pragma once

#include <gtest/gtest.h>

#include "core/cell/cell.hpp"
#include "core/cell/milling/tool_library.hpp"
#include "core/mill/drive/held_tool.hpp"
#include "core/mill/mill_job.hpp"
#include "tests/core/mill/milled_plan.hpp"

namespace sculpt {

class HeldD6 : public testing::Test {
 protected:
  static constexpr int n = 32;
  static constexpr double room_m = 0.06;

  const HeldTool::Fields& fields(const Direction& direction) {
    return held.fields(direction, home, {0, helpers, watch});
  }

  const Cell cell = parse_cell(milled::make_job("bust", n, {"D6"}).cell);
  const Grid grid = cell.grid(n);
  const Configuration home = cell.home(cell.chain());
  const MillTool tool = choose_tools(read_tool_library(SOURCE_DIR "/config/tools/carving.json", {}), {"D6"}).front();
  const Grid around = grid_around(grid, room_m);
  HeldTool held{cell, tool, grid, around};
  const Helpers helpers{2};
  const Watch watch;
};

}  // namespace sculpt
