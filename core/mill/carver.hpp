// Carries out what the stages of milling plan: the arm follows, the stock and the nails lose what is cut, and all of it
// is counted.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/run_context.hpp"
#include "core/mill/drive/mill_arm.hpp"
#include "core/mill/drive/reach_floor.hpp"
#include "core/mill/finish/nails.hpp"
#include "core/mill/map/site.hpp"
#include "core/mill/mill_job.hpp"
#include "core/mill/mill_memory.hpp"
#include "core/mill/mill_stock.hpp"
#include "core/mill/piece_watch.hpp"
#include "core/mill/tool_meter.hpp"

namespace sculpt {

/// Not shared between threads.
class Carver {
 public:
  using Emit = std::function<void(std::vector<Keyframe>)>;

  /// All must outlive the object.
  Carver(const MillJob& job, const Emit& emit, const RunContext& run);

  /// The first one is in the spindle already. Throws InputError `no_transit` where no way leads to where it is changed.
  void take_tool(std::size_t number);
  /// As a run did that ended after it had taken a tool; gives the number of that. Instead of taking the first one.
  /// Throws Cancelled.
  std::size_t go_on(MillStart start);
  /// When a tool was taken: what another run needs to know to go on.
  MillMemory memory() const { return {figures(), arm_.memory(), nails_.reachable()}; }
  /// What came of all tools until now.
  std::vector<ToolFigures> figures() const;
  void go_home() { arm_.go_home(); }

  const MillTool& tool() const { return held_->assembly().tool; }
  /// The lowest place of the stock, as it was at the start, in a direction's frame (m).
  double bottom(const ToolFrame& frame) const;
  /// How much was cut until now: another number wherever what stands may be another.
  std::uint64_t cuts() const { return cuts_; }
  /// Voxels that are not removed.
  const SweptSet& left() const { return stock_.left(); }
  /// Those in which something may stand.
  const VoxelSet& standing();
  /// As they are now whenever the tip is at the hub, or once the carver has settled.
  const Nails& nails() const { return nails_; }
  void mark_reachable(std::size_t nail) { nails_.mark_reachable(nail); }
  /// Of the wishes.
  double stray_m() const { return job_.wishes.stray_m(); }

  /// A direction, its maps over cells of `step_m`, for the tool that is held. It has not seen what stands yet.
  std::unique_ptr<Site> make_site(std::size_t direction, const SiteMargins& margins, double step_m) const;

  /// Holds the tool in a direction whose site has seen what stands, high above everything, so that the robot comes to
  /// as many of these places (of the tip, stock frame) as it can; false where it comes to none.
  bool enter(std::size_t direction, const Site& site, const std::vector<Vec3>& places);
  /// In the direction that was entered.
  const ReachFloor& reach() const { return *floor_; }
  const Vec3& hub() const { return hub_; }
  const SweptCutter& swept() const { return sweeps_->of_centres; }
  /// Of that direction's frame.
  Vec3 tip(const Site& site) const { return site.frame().of(*arm_.tip()); }

  /// Follows strokes as far as that goes, and as long as no piece larger than a chip comes loose; gives how many that
  /// are. If it is not all of them, the tip stays where the last one ended that cuts.
  std::size_t carry_out(const std::vector<MillStroke>& strokes);
  /// Up from where the tip is and over to the hub; where that is not possible, from a place where the tip was before.
  void draw_back(const Site& site);
  /// What stands and the nails lose all that was cut.
  void settle();

 private:
  /// It has seen what stands.
  std::unique_ptr<HeldTool> make_held(const MillTool& tool);
  std::unique_ptr<ToolMeter> make_meter(const MillTool& tool, ToolFigures figures) const;
  void count(const std::vector<Keyframe>& keyframes);
  void go(FollowedMill followed);
  void remove(FollowedMill& followed);
  void clear_due();
  void cut_nails_due();
  bool hold(std::size_t direction, const Site& site, const PostureField& field);

  const MillJob& job_;
  const RunContext& run_;
  MillStock stock_;
  PieceWatch pieces_;
  Nails nails_;
  std::uint64_t to_remove_, removed_ = 0, cuts_ = 0;
  Eigen::AlignedBox3d stock_box_;  ///< around what was clamped (stock frame, m)
  Mesh fixtures_;
  Grid around_;
  std::unique_ptr<HeldTool> held_;
  std::vector<ToolFigures> done_;  ///< of the tools before the one that is held
  std::unique_ptr<ToolMeter> meter_;
  std::optional<MillSweeps> sweeps_;
  std::vector<CutEdge> due_;  ///< removed from the stock, but what stands and the nails have yet to lose them
  std::unique_ptr<const ReachFloor> floor_;
  Vec3 hub_ = Vec3::Zero(), axis_ = Vec3::UnitZ();
  std::optional<Vec3> tip_;  ///< of the last keyframe that was counted
  std::vector<Vec3> trail_;  ///< where it was before, since the direction was entered
  Emit emit_;
  MillArm arm_;
};

}  // namespace sculpt
