// Configurations at the nodes of a lattice over the grid, grown from one node outwards.
//
// A lattice of 16 cells along each edge, 17 nodes; a grid of 64 voxels has a node every 4 voxels. For the direction +z:
//
//      first node, from `start`                       o known   + grown in the first round, every other node
//                |                                    . in the second: between two of those, by a polynomial
//      +  .  +  .o  .  +  .  +    c = 65.5 (top)        x none: an entry past a joint limit, or on another branch
//      .  .  .  .  .  .  .  .  .
//      +  .  +  .  +  .  x  .  +
//
// With joint 3 at 0.40, 0.52, 0.60 and 0.64 rad at four nodes of the first round in a row, the node in the middle of
// them gets (9 * (0.52 + 0.60) - 0.40 - 0.64) / 16 = 0.565 rad, where a straight line would say 0.56. Were that more
// than 0.02 off the line the node would be solved for instead. Within a cell a configuration is guessed by trilinear
// interpolation.
#pragma once

#include <cmath>
#include <deque>
#include <optional>
#include <vector>

#include "core/base/watch.hpp"
#include "core/cell/chain.hpp"
#include "core/collision/bubble.hpp"
#include "core/sweep/field/posture_lanes.hpp"
#include "core/sweep/reach/tool_view.hpp"

namespace sculpt {

/// The lattice lies over the grid and two voxels beyond it, on the sides that the tool's axis leans to. Its cells are
/// cut into parts, which a corner names: the lowest of a part's eight. Reads are safe from several threads.
class PostureLattice {
 public:
  static constexpr int cells = 16;  ///< along each edge
  static constexpr int parts = 2;   ///< of a cell along each edge
  static constexpr int fine = cells * parts;
  static constexpr std::size_t all_parts() { return static_cast<std::size_t>(fine) * fine * fine; }
  static std::size_t index_of(Voxel part) {
    const int index = (part.k * fine + part.j) * fine + part.i;
    return static_cast<std::size_t>(index);
  }

  /// Where a lattice begins to grow.
  struct Start {
    Configuration q;                   ///< with the ball at about the hub
    int i = cells / 2, j = cells / 2;  ///< a node of the top
  };

  static Voxel part_of(std::size_t index) {
    const int at = static_cast<int>(index);
    return {at % fine, at / fine % fine, at / fine / fine};
  }

  /// Grows from `start`. Throws Cancelled.
  PostureLattice(const Chain& chain, const Grid& grid, const ToolView& view, const Start& start, const Watch& watch);

  /// For a direction that it is turned to by adding `turn` to the joints.
  void turn(const ToolView& view, const Configuration& turn);

  const Configuration& start() const { return start_.q; }
  const Start& origin() const { return start_; }
  /// The cell of the view above the grid at the node that a lattice grew from.
  static Voxel hub_of(int n, const Start& start) { return {n * start.i / cells, n * start.j / cells, n + 1}; }
  const Chain& chain() const { return chain_; }
  const Grid& grid() const { return grid_; }
  const PostureLanes& lanes() const { return lanes_; }
  const ToolView& view() const { return view_; }
  Vec3 ball_m(const Vec3& cell) const { return view_.ball_m(grid_, cell); }

  /// The part that a place is in (cells of the view).
  Voxel part(const Vec3& cell) const;
  /// Place of a corner, and of the middle of the cube of `size` parts above it.
  Vec3 corner_cell(Voxel corner) const;
  Vec3 middle_cell(Voxel corner, int size) const;
  /// The farthest that the ball comes: where there is no headroom, to the centres of the last voxels.
  Vec3 last_cell() const;

  /// About the configuration with the ball at `cell`, between nodes; not a number where one is missing.
  Configuration guess(const Vec3& cell) const;
  /// Does the cube of `size` parts have all nodes of the cells that it lies in?
  bool has_nodes(Voxel corner, int size) const;
  /// The configurations at its corners, and in larger cubes than a cell at all nodes; none where one is missing.
  std::vector<Configuration> find_corners(Voxel corner, int size) const;
  /// All that the nodes lie in, with something to spare; without values if there is no node.
  JointBox bounds() const;

 private:
  static constexpr int nodes = cells + 1;
  Voxel first_node() const { return {start_.i, start_.j, cells}; }
  static bool is_node(Voxel v) { return Grid{nodes, 1, Vec3::Zero()}.contains(v); }
  template <typename Do>
  static void for_each_node(const Do& visit) {
    for (int k = 0; k < nodes; ++k)
      for (int j = 0; j < nodes; ++j)
        for (int i = 0; i < nodes; ++i) visit(Voxel{i, j, k});
  }
  static Eigen::Index node_index(Voxel node) { return (node.k * nodes + node.j) * nodes + node.i; }
  auto node_at(Voxel node) { return nodes_.col(node_index(node)); }
  auto node_at(Voxel node) const { return nodes_.col(node_index(node)); }
  bool has_node(Voxel node) const { return !std::isnan(nodes_(0, node_index(node))); }
  /// A node, and about its configuration.
  struct Visit {
    Voxel node;
    Configuration guess;
  };
  void grow(const Watch& watch);
  void spread(std::deque<Visit> queue, int stride, const Watch& watch);
  void fill_between();
  std::optional<Configuration> find_between(Voxel node, Voxel along) const;

  Chain chain_;
  Grid grid_;
  ToolView view_;
  PostureLanes lanes_;
  Start start_;
  Vec3 low_, span_;        ///< of the lattice, in cells of the view
  Vec3 parts_per_cell_;    ///< of the lattice, to a cell of the view
  Eigen::MatrixXd nodes_;  ///< a configuration in each column; not numbers where there is none
};

}  // namespace sculpt
