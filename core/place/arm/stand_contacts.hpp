// Do links touch the block, the room or each other at one configuration: the quick question of a study, not a
// certificate.
#pragma once

#include <memory>
#include <vector>

#include "core/collision/shape/body.hpp"
#include "core/place/arm/free_cells.hpp"

namespace sculpt {

/// What a study finds in the way.
enum class StandContact { none, stock, links };

/// The bodies of a cell and which of them are kept apart, found once where the cell stands. Immutable: safe to share
/// between threads.
class StandContacts {
 public:
  /// `cell` as it stands, with the tool of the study, and the joint that is to be moved; only read during the call.
  StandContacts(const Cell& cell, int joint, const Grid& grid);

  /// Does something that was moved, or the block, stand in something that no joint of the chain moves against it, and
  /// that it does not touch where the cell stands? The planner looks at none of these. Arguments as of `at`.
  bool is_blocked(const std::vector<Frame>& poses, const Body& block) const;

  /// The first contact found at q. `poses`: of all links in the stock frame, as Chain::link_poses gives them. `block`:
  /// the stock as one body in that frame. Ball and shank may touch the block. `last`: the number of the pair of links
  /// that touched last, which is asked for first; it becomes that of the one that does.
  StandContact at(const Chain& chain, const Configuration& q, const std::vector<Frame>& poses, const Body& block,
                  std::size_t& last) const;

  /// Do ball or shank touch the block? Arguments as of `at`.
  bool tool_touches(const std::vector<Frame>& poses, const Body& block) const;

 private:
  struct Pair {
    std::size_t first, second;
    double margin_m;
    std::unique_ptr<FreeCells> cells = {};  ///< of links that the moved joint does not move against each other
  };

  void find_cells(const Cell& cell, int joint);
  void find_standing(const Cell& cell, int joint, const Grid& grid, std::size_t whole);

  std::vector<Body> bodies_;
  std::vector<std::size_t> beside_stock_;  ///< bodies that move against the stock
  std::vector<Pair> pairs_;
  std::vector<Pair> standing_;             ///< of what was moved and what was not, rigidly joined
  std::vector<std::size_t> beside_block_;  ///< that stand still with the stock on the other side of the moved joint
};

/// A box of the stock's frame as a body.
Body make_block(const Eigen::AlignedBox3d& box_m);

}  // namespace sculpt
