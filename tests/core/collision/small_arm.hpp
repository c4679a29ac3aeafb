// A small arm for tests: a table that turns under the stock, a post, and three revolute joints with a spindle.
#pragma once

#include "core/cell/cell.hpp"

namespace sculpt {

inline Cell make_test_cell() {
  CellFiles files;
  files.name = "test-arm";
  files.cell_json = R"({
    "urdf": "arm.urdf",
    "stock": {"link": "disc", "size_m": 0.16, "origin_m": [-0.08, -0.08, 0.0]},
    "tool": {"link": "nose", "stickout_m": 0.2, "ball_radius_voxels": 0.45, "shank_radius_voxels": 0.40},
    "home": {"table": 0, "shoulder": -0.6, "elbow": 1.2, "wrist": 1.0}
  })";
  files.files["arm.urdf"] = R"(<robot name="test-arm">
    <link name="base"><collision><origin xyz="0 0 -0.05"/><geometry><box size="2 2 0.1"/></geometry></collision></link>
    <link name="disc"><collision><origin xyz="0 0 -0.01"/><geometry><cylinder radius="0.08" length="0.02"/></geometry></collision></link>
    <joint name="table" type="revolute"><parent link="base"/><child link="disc"/><origin xyz="0.5 0 0.12"/><axis xyz="0 0 1"/>
      <limit lower="-3.1" upper="3.1" effort="1" velocity="1"/></joint>
    <link name="upper"><collision><origin xyz="0 0 0.2"/><geometry><cylinder radius="0.04" length="0.4"/></geometry></collision></link>
    <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="0 0 0.3"/><axis xyz="0 1 0"/>
      <limit lower="-1.5" upper="1.5" effort="1" velocity="1"/></joint>
    <link name="fore"><collision><origin xyz="0 0 0.15"/><geometry><box size="0.06 0.06 0.3"/></geometry></collision></link>
    <joint name="elbow" type="revolute"><parent link="upper"/><child link="fore"/><origin xyz="0 0 0.4"/><axis xyz="0 1 0"/>
      <limit lower="-2.5" upper="2.5" effort="1" velocity="1"/></joint>
    <link name="nose"><collision><geometry><sphere radius="0.03"/></geometry></collision></link>
    <joint name="wrist" type="revolute"><parent link="fore"/><child link="nose"/><origin xyz="0 0 0.35"/><axis xyz="0 1 0"/>
      <limit lower="-2.5" upper="2.5" effort="1" velocity="1"/></joint>
  </robot>)";
  return parse_cell(files);
}

}  // namespace sculpt
