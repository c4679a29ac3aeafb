// A cell with one of a plan's tools, and what must be kept apart in it. Internal to verify/. Millimetres.
#pragma once

#include <optional>
#include <vector>

#include "core/cell/milling/mill_tool.hpp"
#include "core/verify/link_replay.hpp"
#include "core/verify/robot/checked_pairs.hpp"

namespace sculpt {

/// The cell with one of the plan's tools, with its cutter and without, and what has to be kept apart then.
struct ToolScene {
  /// `material` must outlive the object, and so must the tool.
  ToolScene(const Cell& base, const MillTool& the_tool, const std::vector<int>& joints, const StandingVoxels& material);
  ToolScene(const ToolScene&) = delete;
  ToolScene& operator=(const ToolScene&) = delete;

  Vec3 tip(const LinkChain::Place& place) const { return place.link * Vec3(0, 0, 1000 * tool.stickout_m); }
  static Vec3 axis(const LinkChain::Place& place) { return -place.link.linear().col(2); }

  const MillTool& tool;
  Cell cell;
  LinkMotion motion;
  LinkChain chain;  ///< from the stock to the tool link
  std::vector<SolidBody> bodies, whole_bodies;
  CheckedPairs pairs, whole_pairs;
  std::optional<LinkReplay> links, whole;  ///< without the cutter, with it
};

}  // namespace sculpt
