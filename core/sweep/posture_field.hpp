// One configuration for every ball position of a tool direction: smooth, within limits, and with links certified free.
#pragma once

#include <cmath>
#include <deque>
#include <vector>

#include "core/base/helpers.hpp"
#include "core/base/watch.hpp"
#include "core/collision/scene.hpp"
#include "core/sweep/posture_lanes.hpp"
#include "core/sweep/tool_view.hpp"

namespace sculpt {

/// Configurations at the nodes of a lattice over the grid and two voxels beyond it, on the sides that the tool's axis
/// leans to, found from one node outwards; between nodes they are guessed by trilinear interpolation and made exact
/// (find_posture). Every cell of the lattice that may be used lies in a bubble: there no link touches anything,
/// whatever is carved. Reads are safe from several threads.
class PostureField {
 public:
  /// `start`: a configuration to begin with, at about the middle of the top. `scene` only has to live during the call.
  PostureField(const Scene& scene, const ToolView& view, const Configuration& start, const Helpers& helpers,
               const Watch& watch);

  /// `other`, for a direction that it is turned to by adding `turn` to the joints. Only where that changes nothing but
  /// the direction (find_stock_turn).
  PostureField(const PostureField& other, const ToolView& view, const Configuration& turn);

  /// Tries again, in finer parts, where no bubble was found. Slow where there is none.
  void refine(const Scene& scene, const Helpers& helpers, const Watch& watch);

  /// Do all configurations stay within the limits if one joint turns by so much more?
  bool can_turn(int coordinate, double by) const {
    return around_.box.low[coordinate] + by > chain_.lower()[coordinate] &&
           around_.box.high[coordinate] + by < chain_.upper()[coordinate];
  }

  /// The configuration that it grew from.
  const Configuration& start() const { return start_; }
  /// Lattice cells that may be used, of all.
  std::size_t usable_cells() const { return usable_; }
  static std::size_t all_cells() { return static_cast<std::size_t>(fine) * fine * fine; }

  /// May the ball's centre be there (cells of the view, centres at whole numbers)?
  bool usable(const Vec3& cell) const { return bubble_[fine_cell(cell)] >= 0; }
  /// The part of the lattice that a place is in: the field is usable in all of it or nowhere in it.
  Voxel part(const Vec3& cell) const { return corner_below(cell); }
  bool usable_part(Voxel part) const { return bubble_[index_of(part)] >= 0; }

  /// About the configuration with the ball at `cell`, between nodes; not a number where one is missing.
  Configuration guess(const Vec3& cell) const;

  /// The configuration with the ball at `cell`; nothing where the field is not usable.
  std::optional<Configuration> at(const Vec3& cell) const;

  /// Is the joint-linear edge free of contacts between links, room, stock and each other, and the straight line of the
  /// ball from `from_cell` to `to_cell`, where it is at the ends, usable all along? `held`: the number of a bubble that
  /// is known to hold `from`, or -1; if the edge is free it becomes that of one that holds `to`.
  bool links_are_free(const Vec3& from_cell, const Configuration& from, const Vec3& to_cell, const Configuration& to,
                      int& held) const;

  /// Is the tool clear of what stands still in the stock's frame even half a voxel off any line between the two?
  bool allows_wide_path(const Vec3& from_cell, const Vec3& to_cell) const {
    return roomy_.contains(from_cell) && roomy_.contains(to_cell);
  }

  const Chain& chain() const { return chain_; }
  const PostureLanes& lanes() const { return lanes_; }
  const ToolView& view() const { return view_; }
  Vec3 ball_m(const Vec3& cell) const { return view_.ball_m(grid_, cell); }

 private:
  static constexpr int cells = 16;  ///< of the lattice along each edge
  static constexpr int nodes = cells + 1;
  static constexpr int parts = 2;  ///< of a cell along each edge, each with a bubble of its own if need be
  static constexpr int fine = cells * parts;

  /// Place of a corner of the fine lattice, in cells of the view.
  Vec3 corner_cell(Voxel corner) const;
  Vec3 last_cell() const;
  static constexpr Voxel first_node{cells / 2, cells / 2, cells};
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
  bool has_nodes(Voxel corner, int size) const;
  /// A box of joint values, and what may touch in it.
  struct Surroundings {
    JointBox box;
    Scene::Pairs pairs;
  };
  /// A cube of the fine lattice.
  struct Cube {
    Voxel corner;
    int size;
    Surroundings around;
  };
  struct Wanted;
  struct Cover;
  std::vector<Configuration> find_corners(const Cube& cube) const;
  Surroundings find_surroundings(const Scene& scene) const;
  Wanted find_wanted(const Cube& cube) const;
  Bubble find_bubble(const Scene& scene, const Wanted& wanted, Cube& cube) const;
  Voxel corner_below(const Vec3& cell) const;
  std::size_t fine_cell(const Vec3& cell) const;
  /// A node, and about its configuration.
  struct Visit {
    Voxel node;
    Configuration guess;
  };
  void grow(const Configuration& start, const Watch& watch);
  void spread(std::deque<Visit> queue, int stride, const Watch& watch);
  void fill_between();
  std::optional<Configuration> find_between(Voxel node, Voxel along) const;
  std::size_t index_of(Voxel corner) const {
    return static_cast<std::size_t>((corner.k * fine + corner.j) * fine + corner.i);
  }
  void cover(const Scene& scene, const std::vector<Cube>& cubes, int smallest, const Helpers& helpers,
             const Watch& watch);
  void cover(const Scene& scene, Cube cube, int smallest, std::optional<std::size_t> tried, bool room, Cover& found,
             const Watch& watch) const;
  bool room_is_clear(const Scene& scene, const Cube& cube) const;
  void close_upwards();
  /// Around the tool by `room_voxels` (voxel edges), for all ball positions in a box of cells.
  bool room_is_clear(const Scene& scene, const Vec3& first, const Vec3& last, double room_voxels) const;
  void find_roomy(const Scene& scene);
  bool line_is_usable(const Vec3& from_cell, const Vec3& to_cell, int splits) const;
  bool in_bubbles(const Vec3& from_cell, const Configuration& from, const Vec3& to_cell, const Configuration& to,
                  int& held, int splits) const;
  Chain chain_;
  Grid grid_;
  ToolView view_;
  PostureLanes lanes_;
  Configuration start_;
  Vec3 low_, span_;                    ///< of the lattice, in cells of the view
  Vec3 parts_per_cell_;                ///< of the lattice, to a cell of the view
  Eigen::MatrixXd nodes_;              ///< a configuration in each column; not numbers where there is none
  std::vector<std::int32_t> covered_;  ///< per cell of the fine lattice: index into bubbles_, or -1
  std::vector<std::int32_t> bubble_;   ///< the same of those that may be used
  std::vector<Bubble> bubbles_;
  Surroundings around_;      ///< of all nodes
  std::vector<Cube> holes_;  ///< where no bubble was found, as small as was tried
  std::size_t usable_ = 0;
  Eigen::AlignedBox3d roomy_;  ///< cells; empty by default
};

}  // namespace sculpt
