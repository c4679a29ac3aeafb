#include "core/place/arm/arm_reach.hpp"

#include <numbers>
#include <utility>

#include "core/place/arm/view_reach.hpp"
#include "core/sweep/stock_turn.hpp"

namespace sculpt {
namespace {

constexpr std::uint64_t seeds_seed = 1;  // a study has no chance of its own: the same cell gives the same seeds
constexpr double no_limit = 1e3;         // rad or m
constexpr std::size_t first_side = 1;    // of the views; four each of a kind follow, each a quarter turn further

Robot without_limits(Robot robot) {
  for (Joint& joint : robot.joints) {
    joint.lower = -no_limit;
    joint.upper = no_limit;
  }
  return robot;
}

ArmReach blocked() {
  ArmReach reach;
  reach.is_blocked = true;
  for (auto& view : reach.holds) view.fill(Hold::links);
  return reach;
}

/// The directions of one stand; of four that are quarter turns of each other the first, if the stock can be turned.
class StandSearch {
 public:
  StandSearch(const StandArm& arm) : arm_(arm), turn_(find_stock_turn(arm.chain, arm.grid)) {}

  ArmReach run() {
    const std::vector<ToolView> views = study_views(arm_.grid.n), sectors = study_views(sectors_along);
    ArmReach reach;
    std::vector<ViewReach> found(all_views);
    for (std::size_t view = 0; view < all_views; ++view) {
      const std::size_t quarters = view < first_side ? 0 : (view - first_side) % 4;
      found[view] = quarters > 0 && can_turn(found[view - quarters], static_cast<double>(quarters))
                        ? found[view - quarters]
                        : find_view_reach(arm_, views[view]);
      for (int k = 0; k < sectors_along; ++k)
        for (int j = 0; j < sectors_along; ++j)
          for (int i = 0; i < sectors_along; ++i)
            reach.holds[view][sector_index(sectors[view].voxel({i, j, k}))] =
                found[view].holds[sector_index({i, j, k})];
    }
    reach.above = found[0].above;
    return reach;
  }

 private:
  bool can_turn(const ViewReach& found, double quarters) const {
    if (!turn_) return false;
    if (found.low.size() == 0) return true;
    for (const double rounds : {0.0, -1.0, 1.0}) {
      const double by = turn_->direction * (quarters / 4 + rounds) * 2 * std::numbers::pi;
      if (found.low[turn_->coordinate] + by > arm_.chain.lower()[turn_->coordinate] &&
          found.high[turn_->coordinate] + by < arm_.chain.upper()[turn_->coordinate])
        return true;
    }
    return false;
  }

  const StandArm& arm_;
  std::optional<StockTurn> turn_;
};

}  // namespace

ReachStudy::ReachStudy(const Cell& cell, int joint, const Eigen::AlignedBox3d& box, int resolution,
                       const std::vector<double>& stickouts_m)
    : cell_(cell),
      joint_(joint),
      box_(box),
      resolution_(resolution),
      seeds_(cell.chain(), cell.home(cell.chain()), seeds_seed) {
  for (const double stickout_m : stickouts_m) {
    Stand stand = stand_of(cell, joint);
    stand.stickout_m = stickout_m;
    contacts_.try_emplace(stickout_m, cell_at(cell, joint, stand), joint, cell.grid(resolution));
  }
}

ArmReach ReachStudy::find(const Stand& stand) const {
  const Cell cell = cell_at(cell_, joint_, stand);
  const Robot free_robot = without_limits(cell.robot);
  const Chain chain = cell.chain(),
              free_chain(free_robot, cell.stock_link, cell.tool_link, cell.tool.stickout_m, cell.rest);
  const Grid grid = cell.grid(resolution_);
  const StandContacts& contacts = contacts_.at(stand.stickout_m);
  const Body block =
      make_block({grid.origin_m + cell.stock_size_m * box_.min(), grid.origin_m + cell.stock_size_m * box_.max()});
  std::vector<Frame> poses;
  chain.link_poses(cell.home(chain), poses);
  if (contacts.is_blocked(poses, block)) return blocked();
  const SeedPoses seed_poses = seeds_.poses(chain);
  ArmReach reach = StandSearch({chain, free_chain, grid, contacts, block, seeds_, seed_poses}).run();
  std::size_t any = 0;
  reach.home_is_free = !contacts.tool_touches(poses, block) &&
                       contacts.at(chain, cell.home(chain), poses, block, any) == StandContact::none;
  return reach;
}

}  // namespace sculpt
