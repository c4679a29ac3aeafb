// Cells and robots for the tests of the doctor.
#pragma once

#include <string>

#include "core/base/helpers.hpp"
#include "core/base/run_context.hpp"
#include "core/cell/cell.hpp"

namespace sculpt {

/// A six-axis arm of simple bodies with a flange whose +x points out of it; no table, no tool.
inline const std::string makers_arm = R"(<?xml version="1.0"?>
<!-- A comment with a <link name="ghost"/> in it. -->
<robot name="maker">
  <link name="base"><collision><origin xyz="0 0 0.1"/><geometry><cylinder radius="0.1" length="0.2"/></geometry></collision></link>
  <link name="l1"><collision><origin xyz="0 0 0.1"/><geometry><cylinder radius="0.08" length="0.14"/></geometry></collision></link>
  <joint name="j1" type="revolute"><parent link="base"/><child link="l1"/><origin xyz="0 0 0.21"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
  <link name="l2"><collision><origin xyz="0 0.12 0.2"/><geometry><box size="0.1 0.06 0.5"/></geometry></collision></link>
  <joint name="j2" type="revolute"><parent link="l1"/><child link="l2"/><origin xyz="0 0 0.2"/><axis xyz="0 1 0"/>
    <limit lower="-1.9" upper="1.9" velocity="1" effort="1"/></joint>
  <link name="l3"><collision><origin xyz="0.15 0 0"/><geometry><box size="0.4 0.1 0.1"/></geometry></collision></link>
  <joint name="j3" type="revolute"><parent link="l2"/><child link="l3"/><origin xyz="0 0 0.4"/><axis xyz="0 1 0"/>
    <limit lower="-2.4" upper="2.4" velocity="1" effort="1"/></joint>
  <link name="l4"><collision><origin xyz="0.02 0 0"/><geometry><box size="0.06 0.06 0.06"/></geometry></collision></link>
  <joint name="j4" type="revolute"><parent link="l3"/><child link="l4"/><origin xyz="0.4 0 0"/><axis xyz="1 0 0"/>
    <limit lower="-3.1" upper="3.1" velocity="1" effort="1"/></joint>
  <link name="l5"/>
  <joint name="j5" type="revolute"><parent link="l4"/><child link="l5"/><origin xyz="0.08 0 0"/><axis xyz="0 1 0"/>
    <limit lower="-2.1" upper="2.1" velocity="1" effort="1"/></joint>
  <link name="l6"><collision><origin xyz="0.05 0 0"/><geometry><box size="0.02 0.05 0.05"/></geometry></collision></link>
  <joint name="j6" type="revolute"><parent link="l5"/><child link="l6"/><origin xyz="0 0 0"/><axis xyz="-1 0 0"/>
    <limit lower="-6" upper="6" velocity="1" effort="1"/></joint>
  <link name="flange"/>
  <joint name="jf" type="fixed"><parent link="l6"/><child link="flange"/><origin xyz="0.07 0 0"/></joint>
  <link name="hand"><collision><origin xyz="0.05 0 0"/><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
  <joint name="jh" type="fixed"><parent link="flange"/><child link="hand"/></joint>
  <link name="left"/><link name="right"/>
  <joint name="jl" type="prismatic"><parent link="hand"/><child link="left"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="0.04" velocity="1" effort="1"/></joint>
  <joint name="jr" type="prismatic"><parent link="hand"/><child link="right"/><axis xyz="0 -1 0"/>
    <limit lower="0" upper="0.04" velocity="1" effort="1"/><mimic joint="jl"/></joint>
</robot>
)";

/// What a run needs besides the seed.
struct QuietRun {
  explicit QuietRun(int threads = 2) : helpers(threads) {}
  Helpers helpers;
  Watch watch{};
  RunContext context(std::uint64_t seed = 0) const { return {seed, helpers, watch}; }
};

}  // namespace sculpt
