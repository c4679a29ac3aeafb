// What a tool can come to along one direction: its maps over the part, over what stands beside it, and over the stock.
#pragma once

#include <algorithm>
#include <mutex>

#include "core/material/voxel_set.hpp"
#include "core/mesh/mesh.hpp"
#include "core/mill/map/offset_map.hpp"

namespace sculpt {

/// By how much a tool keeps off (m).
struct SiteMargins {
  double cutter_m = 0;  ///< the cutter off the part: what is left for later, and what it may stray
  double body_m = 0;    ///< what is above the cutter, off everything
};

/// Heights are along the frame's axis, in metres, and bounds for whole cells. Immutable but for `see`.
class Site {
 public:
  /// `part`, `fixtures`: stock frame. `lattice` reaches beyond both by the assembly's radius.
  Site(const ToolFrame& frame, const Lattice& lattice, const Assembly& assembly, const Mesh& part, const Mesh& fixtures,
       const SiteMargins& margins);

  const ToolFrame& frame() const { return frame_; }
  const Lattice& lattice() const { return limit_.lattice; }
  /// The tip may not be lower, for part and fixtures.
  const HeightMap& limit() const { return limit_; }

  /// What stands from now on; less than before.
  void see(const VoxelSet& standing, const Grid& grid, const Helpers& helpers);
  /// The top of what stands.
  const HeightMap& stands() const { return stands_; }
  /// The tip may not be lower, for what the body would touch of it.
  const HeightMap& body_limit() const { return body_limit_; }

  /// The tip may not be lower, for all of that; by cell.
  double lowest_tip(std::size_t cell) const {
    return static_cast<double>(std::max(limit_.heights[cell], body_limit_.heights[cell]));
  }

  /// The tip may not be lower, for what the cutter would touch of fixtures, and the body of anything.
  double floor(int a, int b) const { return static_cast<double>(std::max(beside_.at(a, b), body_limit_.at(a, b))); }
  /// The highest place of what stands.
  double top() const { return static_cast<double>(*std::ranges::max_element(stands_.heights)); }

  /// The lowest height at which the whole tool goes over from one place to the other (tool frame) and touches nothing,
  /// `above_m` above all that the cutter could that is no farther than `beside_m` from it.
  double clear_height(const Vec3& from, const Vec3& to, double above_m, double beside_m) const;
  /// The lowest height of the tip over a place at which, and above which, the cutter keeps off what stands by so much.
  double free_height(const Vec3& at, double clearance_m) const;

  /// Of each cell how low the cutter comes to it, once no stock is in the body's way; found when first asked for. Any
  /// thread.
  const HeightMap& lowest_cut() const {
    std::call_once(lowest_cut_is_found_, [this] { lowest_cut_ = sculpt::lowest_cut(limit_, cutter_); });
    return lowest_cut_;
  }

 private:
  ToolFrame frame_;
  Cutter cutter_;
  std::vector<Ring> rings_;
  SiteMargins margins_;
  HeightMap limit_, beside_, stands_, body_limit_;
  mutable std::once_flag lowest_cut_is_found_;
  mutable HeightMap lowest_cut_;
};

}  // namespace sculpt
