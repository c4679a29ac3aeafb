// How far from the certified path a motion may stray: what the planners' margins leave, and what joints make of it.
#pragma once

#include <utility>
#include <vector>

#include "core/cell/cell.hpp"
#include "core/collision/shape/body.hpp"
#include "core/timing/plan_path.hpp"

namespace sculpt {

inline constexpr double share_of_link_margin = 0.75;

/// Every planner certifies its edges with these to spare (core/collision/margins): 0.2 mm between links, and from links
/// to material, or 0.6 of the gap that two links have at home; 0.005 voxel about ball and shank. A configuration that
/// is off a certified one by d_j in joint j is therefore free if, for all pairs of bodies, sum R_j |d_j| is below what
/// the certificate leaves, where R_j bounds how fast the two move against each other (motion_bound), and if ball and
/// shank are off by less than theirs. Three quarters of the links' margin may be used, three fifths of the tool's: what
/// is left is for the replay to prove.
class StrayBound {
 public:
  /// `reserve_m`: of all margins, for what rounds the numbers later. The cell must outlive this. Throws InputError
  /// `reserve_invalid` where nothing is left.
  StrayBound(const Cell& cell, const Chain& chain, const Grid& grid, double reserve_m);

  /// Where the tool is one of the links, and room for it is known of each edge: tool_m() is next to nothing.
  static StrayBound of_links(const Cell& cell, const Chain& chain, double reserve_m);

  double reserve_m() const { return reserve_m_; }
  /// Ball and shank's end may stray that far from where the path has them (m), on every certified edge.
  double tool_m() const { return tool_m_; }
  /// Share of what links may come nearer to each other or to the stock that they do by |d_j|.
  double links(const Configuration& size) const;
  /// The same at a point of the path of the tool and the links that can move against the stock: share of what these two
  /// may come nearer to each other by |d_j|. `above`: ball and shank surely stay above the stock's bottom.
  double tool_and_links(std::size_t point, bool above, const Configuration& size) const;
  /// The same anywhere. `tool_m`: how far ball and shank are displaced in the stock's frame.
  double tool_and_links(const Configuration& size, double tool_m) const;
  /// The same on a straight way, which is looked at closely where that takes more than all.
  double tool_and_links(const std::pair<Configuration, Configuration>& way, const Configuration& size,
                        double tool_m) const;
  /// Finds out where on the path the tool is far from the links that may come beside the stock. To be called once.
  void look_along(const PlanPath& path);

 private:
  StrayBound(const Cell& cell, const Chain& chain, std::vector<Body> bodies, double reserve_m);
  void add_others();
  static constexpr double far_m = 1e-3;
  static constexpr std::size_t points_a_stretch = 8, stretches_beside = 8, stretches_a_look = 32;
  static constexpr int max_halvings = 14;
  void add_links_and_stock();
  void add_link_pairs();
  void add_speed(const Configuration& share);
  /// Bodies that the tool must stay off.
  struct Others {
    struct One {
      std::size_t body;
      Configuration speed, own;  ///< seen from the tool, and from the stock
    };
    std::vector<One> all;
    Configuration most;      ///< of their speeds
    std::vector<bool> near;  ///< by stretch of the path: the tool may be near one of them
  };
  bool stays_below(const Body& body, const Configuration& q) const;
  void look_at(const PlanPath& path, Others& others, std::size_t first, std::size_t end) const;
  bool is_far_along(const Others& others, const Configuration& from, const Configuration& to, int halvings) const;
  bool is_far(const Others& others, const Configuration& low, const Configuration& high) const;
  double share(const Others& others, std::size_t point, const Configuration& size, double tool_m) const;
  double share(const Others& others, const Configuration& size, double tool_m) const;

  const Cell& cell_;
  const Chain& chain_;
  std::vector<Body> bodies_;
  double bottom_m_ = 0, reserve_m_, tool_m_ = 1e-9;
  std::vector<Configuration> links_;  ///< speeds by the room there is, of pairs; none is below another in all joints
  Others beside_, below_;             ///< the latter are always more than far_m below the stock's bottom
};

}  // namespace sculpt
