// One configuration for every ball position of a tool direction: smooth, within limits, and with links certified free.
//
// Where the ball is at cell (10.3, 4, 7) of the view, the lattice guesses a configuration between its nodes, and two
// steps of Gauss-Newton make it exact (find_posture). Is the edge from there to (14.3, 4, 7) free for links?
//
//        part p          part q          bubble 5 is for p, bubble 9 for q; each is a convex set of configurations
//      +-----------+ +-----------+
//      | from *----|-|---* to    |       1. the ball's line passes parts that may be used only: p, q
//      +-----------+ +-----------+       2. bubble 5 holds `from` and `to`? Then all of the edge is free.
//                                        3. Else bubble 9? Else both halves of the edge are asked for, up to 12 times.
//
// That is a few products per edge: the distances were asked for once, when the bubbles were found.
#pragma once

#include <optional>
#include <vector>

#include "core/base/helpers.hpp"
#include "core/base/watch.hpp"
#include "core/collision/scene.hpp"
#include "core/sweep/field/bubble_cover.hpp"
#include "core/sweep/field/posture_lattice.hpp"

namespace sculpt {

/// A lattice of configurations, and the bubbles that say where it may be used. Reads are safe from several threads.
class PostureField {
 public:
  /// What it takes to make it again without asking for distances.
  struct Record {
    PostureLattice::Start start;
    BubbleCover cover;
    Eigen::AlignedBox3d roomy;
  };

  /// `scene` only has to live during the call. Throws Cancelled.
  PostureField(const Scene& scene, const ToolView& view, const PostureLattice::Start& start, const Helpers& helpers,
               const Watch& watch);

  /// As `record` of a field of the same scene and direction has it. Throws Cancelled.
  PostureField(const Scene& scene, const ToolView& view, Record record, const Watch& watch);
  Record record() const { return {lattice_.origin(), cover_, roomy_}; }

  /// `other`, and those of the `wanted` parts that are free where only `stock` of the scene's stands any longer. Throws
  /// Cancelled.
  PostureField(const PostureField& other, const Scene& scene, const Body& stock, const VoxelSet& wanted,
               const Helpers& helpers, const Watch& watch);

  /// `other`, for a direction that it is turned to by adding `turn` to the joints. Only where that changes nothing but
  /// the direction (find_stock_turn).
  PostureField(const PostureField& other, const ToolView& view, const Configuration& turn);

  /// Tries again, in finer parts, where no bubble was found. Slow where there is none. Throws Cancelled.
  void refine(const Scene& scene, const Body& stock, const Helpers& helpers, const Watch& watch);

  /// Do all configurations stay within the limits if one joint turns by so much more? Not where there are none.
  bool can_turn(int coordinate, double by) const {
    return cover_.bounds().low.size() > 0 && cover_.bounds().low[coordinate] + by > chain().lower()[coordinate] &&
           cover_.bounds().high[coordinate] + by < chain().upper()[coordinate];
  }

  /// The configuration that it grew from.
  const Configuration& start() const { return lattice_.start(); }
  /// Where the tool comes in: a cell of the view, above the grid, usable if any above a node of the lattice is.
  Voxel hub() const { return hub_; }
  /// Parts of the lattice that may be used, of all.
  std::size_t usable_cells() const { return cover_.usable_parts(); }
  static std::size_t all_cells() { return PostureLattice::all_parts(); }

  /// May the ball's centre be there (cells of the view, centres at whole numbers)?
  bool usable(const Vec3& cell) const { return cover_.is_usable(lattice_.part(cell)); }
  /// The part of the lattice that a place is in: the field is usable in all of it or nowhere in it.
  Voxel part(const Vec3& cell) const { return lattice_.part(cell); }
  bool usable_part(Voxel part) const { return cover_.is_usable(part); }

  /// About the configuration with the ball at `cell`, between nodes; not a number where one is missing.
  Configuration guess(const Vec3& cell) const { return lattice_.guess(cell); }

  /// The configuration with the ball at `cell`; nothing where the field is not usable.
  std::optional<Configuration> at(const Vec3& cell) const;

  /// Is the joint-linear edge free of contacts between links, room, stock and each other, and the straight line of the
  /// ball from `from_cell` to `to_cell`, where it is at the ends, usable all along? `held`: the number of a bubble that
  /// is known to hold `from`, or -1; if the edge is free it becomes that of one that holds `to`.
  bool links_are_free(const Vec3& from_cell, const Configuration& from, const Vec3& to_cell, const Configuration& to,
                      int& held) const;

  /// Places that the ball may come by on its way from one place to another of the same height, the last one among them:
  /// that one alone where nothing is in the way, or where there is no way around through parts of this height.
  std::vector<Vec3> way_over(const Vec3& from_cell, const Vec3& to_cell) const;

  /// Is the tool clear of what stands still in the stock's frame even half a voxel off any line between the two?
  bool allows_wide_path(const Vec3& from_cell, const Vec3& to_cell) const {
    return roomy_.contains(from_cell) && roomy_.contains(to_cell);
  }

  const Chain& chain() const { return lattice_.chain(); }
  const PostureLanes& lanes() const { return lattice_.lanes(); }
  const ToolView& view() const { return lattice_.view(); }
  Vec3 ball_m(const Vec3& cell) const { return lattice_.ball_m(cell); }

 private:
  void find_roomy(const Scene& scene);
  void find_hub();
  bool line_is_usable(const Vec3& from_cell, const Vec3& to_cell, int splits) const;
  bool in_bubbles(const Vec3& from_cell, const Configuration& from, const Vec3& to_cell, const Configuration& to,
                  int& held, int splits) const;

  PostureLattice lattice_;
  BubbleCover cover_;
  Eigen::AlignedBox3d roomy_;  ///< cells; empty by default
  Voxel hub_;
};

}  // namespace sculpt
