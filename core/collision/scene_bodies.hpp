// The bodies of a scene, which of them must stay apart, and how far apart they are. Internal to collision/.
#pragma once

#include <algorithm>
#include <atomic>
#include <optional>
#include <utility>
#include <vector>

#include "core/cell/cell.hpp"
#include "core/collision/bubble.hpp"
#include "core/collision/clearance.hpp"
#include "core/collision/contact.hpp"
#include "core/collision/keep_apart.hpp"
#include "core/collision/link_pairs.hpp"
#include "core/collision/material.hpp"
#include "core/collision/shape/body.hpp"
#include "core/collision/shape/motion_bound.hpp"
#include "core/collision/tool_sweep.hpp"

namespace sculpt {

/// All that a Scene knows; it may be read as it is, by those who ask the questions of scene.hpp.
class SceneBodies {
 public:
  /// A body as it moves seen from another one, or from the stock.
  struct Mover {
    int body;
    Configuration speed, turn;  ///< motion_bound of all of the body, turn_bound
    std::vector<Drive> drives;
  };
  /// Two bodies, or a body and the material, that must stay apart.
  struct Pair {
    int first, second;  ///< bodies; second = -1: the material
    double margin_m;  ///< kept between the two; intervals on which they move less than half of it are not split further
    std::vector<Mover> movers;    ///< first seen from second, and second from first: either alone bounds their approach
    Configuration grid_speed;     ///< motion_bound of all of the grid, seen from the body; of two bodies none
    bool of_links = false;        ///< and not of the tool or the material
    bool tool_and_fixed = false;  ///< the tool and what stands still in the stock's frame
    bool never_touch = false;     ///< moved against each other by one joint only, and free all along its range
    Eigen::Index coordinate = -1;  ///< that joint's, where it is free in parts of its range only:
    std::vector<std::pair<double, double>> free_ranges = {};  ///< where it surely is, in order

    /// The one that moves less.
    const Mover& mover(const Configuration& joint_steps) const {
      return movers.size() == 1 || movers[0].speed.dot(joint_steps) <= movers[1].speed.dot(joint_steps) ? movers[0]
                                                                                                        : movers[1];
    }
    double motion(const Configuration& joint_steps) const {
      const double least = mover(joint_steps).speed.dot(joint_steps);
      return second < 0 ? std::min(least, grid_speed.dot(joint_steps)) : least;
    }
    /// Does one joint move the two, and are they surely free wherever it stands between these?
    bool is_free_between(const Configuration& from, const Configuration& to) const {
      if (coordinate < 0) return false;
      const auto [low, high] = std::minmax(from[coordinate], to[coordinate]);
      return std::any_of(free_ranges.begin(), free_ranges.end(), [low = low, high = high](const auto& range) {
        return range.first <= low && high <= range.second;
      });
    }
    /// Two bodies that do not turn against each other where these joints move?
    bool slides(const Configuration& joint_steps) const { return second >= 0 && movers[0].turn.dot(joint_steps) == 0; }
    Contact contact() const { return second < 0 ? Contact::link_material : Contact::link_link; }
    /// How many joints move the two against each other.
    Eigen::Index joints() const { return (movers[0].speed.array() > 0).count(); }
  };

  /// No pairs but `open` touch anywhere in `box`. If it has parts they are settled[parts] and the one behind it: below
  /// and above `split` of a coordinate.
  struct SettledBox {
    JointBox box;
    std::vector<const Pair*> open;
    std::size_t parts = 0;
    Eigen::Index coordinate = 0;
    double split = 0;
  };

  SceneBodies(const Cell& cell, const Grid& where, const VoxelSet& standing);

  void count_check() const { checks.fetch_add(1, std::memory_order_relaxed); }
  ToolLine tool_line(const ToolPose& pose) const;
  bool tool_meets_material(const ToolPose& pose, std::optional<Voxel> exempt) const;
  /// Could the two come within `reach_m`, with the links at these poses?
  bool near(const Pair& pair, const std::vector<Frame>& at, double reach_m) const;
  /// The same of a pair that slides, from `end` to as far on the other side; but for the margin.
  bool near_sliding(const Pair& pair, const std::vector<Frame>& at, const Configuration& end) const;
  /// Of a box, the part where the motion bounds hold: within the limits of what shifts something.
  JointBox bounded(const JointBox& box) const { return {box.low.cwiseMax(bounds.low), box.high.cwiseMin(bounds.high)}; }
  /// Those that may touch on an edge from one configuration to the other, as far as that is known beforehand.
  std::vector<const Pair*> open_between(const Configuration& from, const Configuration& to) const;
  /// Halves the box as long as something is open in a part.
  void settle(const JointBox& box);
  /// Certifies the pairs in `open` on the interval of half width `half` (of the edge's parameter) around `middle`.
  Contact certify_links(const Configuration& from, const Configuration& step, double middle, double half,
                        const std::vector<const Pair*>& open) const;
  /// Is the tool short of the plane between the voxel of `run` that it removes and the next, all along the edge?
  bool stays_behind_rest(const ToolEdge& edge, const VoxelLine& run) const;
  /// Refers to both.
  ToolEdge tool_edge(const Configuration& from, const Configuration& to) const;
  /// Of an edge within the limits on which the tool moves like this.
  Contact certify(const Configuration& from, const Configuration& to, const ToolEdge& edge, const Exempt& exempt) const;
  /// Bound on the second derivative of any tool point along from + t step.
  double tool_second_derivative(const Configuration& step) const;

  // For bubbles.
  /// Of `mover` of the pair, seen from the other body, in the box of +-half.
  RelativeMotion motion_of(const Mover& mover, int seen_from, const std::vector<Frame>& at,
                           const Configuration& half) const;
  bool is_free_in(const Pair& pair, const JointBox& box, int& checks_left) const;

  Chain chain;
  Grid grid;
  Tool tool;
  Material material;
  std::vector<Body> bodies;
  Body stock;                      ///< as it stood first
  std::vector<const Body*> fixed;  ///< those that stand still in the stock's frame
  std::vector<Pair> pairs;
  std::vector<UncheckedLinks> unchecked;
  Configuration tool_speed;         ///< voxel edges per unit of each coordinate, for the shank's whole length
  Configuration turn_rates;         ///< rad per unit of each coordinate
  ToolRadii radii;                  ///< voxel edges
  JointBox bounds;                  ///< where the motion bounds hold
  std::vector<SettledBox> settled;  ///< the first holds all others; none: nothing is known
  bool has_mimic = false;
  mutable std::atomic<std::uint64_t> checks = 0;
  mutable std::atomic<std::size_t> last_contact = 0;  ///< of `pairs`, for any thread: where to look first

 private:
  /// A body seen from a link.
  Mover make_mover(int body, int from_link) const;
  Configuration grid_speed_from(int link) const;
  void add_pairs(const Cell& cell);
  void add_pair(int a, int b, double margin_m);
  void find_free_ranges();
  void settle(std::size_t at, int halvings);
  bool never_touch(const Pair& pair) const;
  void add_free_ranges(Pair& pair, double low, double high) const;
  JointBox find_bounds() const;
};

}  // namespace sculpt
