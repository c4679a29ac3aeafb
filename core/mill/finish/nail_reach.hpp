// Along which directions a ball cutter comes to each nail.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/run_context.hpp"
#include "core/mill/carver.hpp"
#include "core/mill/finish/free_ball.hpp"
#include "core/mill/finish/part_views.hpp"

namespace sculpt {

/// May the tip be there (tool frame), for what is above the cutter?
bool is_above_floor(const Site& site, const Vec3& tip);

/// For the tool that a carver holds, and as many nails as its rows need: evenly some of them; all where it is the last
/// that finishes. Not shared between threads.
class NailReach {
 public:
  /// All must outlive the object.
  NailReach(const MillJob& job, PartViews& views, Carver& carver, bool is_last, const RunContext& run);

  /// Of all open nails that face a direction: could the cutter come to them along it? Those are marked as reachable.
  /// Throws Cancelled.
  void find();
  /// In a crease the cutter cannot rest on a nail; beside it, perhaps, and still leave no more than the tolerance. Of
  /// open nails that nothing was found for. Throws Cancelled.
  void find_beside();

  /// How many nails these are, and how much of the surface there is for each.
  std::size_t asked() const { return (nails_.size() + stride_ - 1) / stride_; }
  double area_m2() const { return static_cast<double>(stride_) * nails_.area_m2(); }
  std::size_t directions() const { return frames_.size(); }
  /// Its maps; made when first asked for, of each direction one thread at a time.
  Site& site(std::size_t direction);
  /// A bit for each direction that the cutter comes to it along.
  std::uint32_t along(std::size_t nail) const { return along_[nail]; }
  /// What stands on it is more than the tolerance, and than a ball beside it would leave.
  bool is_open(std::size_t nail) const { return is_open(nail, nails_.excess(nail)); }
  /// If so much stood on it.
  bool is_open(std::size_t nail, double excess_m) const {
    return excess_m > std::max(job_.wishes.tolerance_m, static_cast<double>(leaves_[nail]));
  }
  /// No nail is finished on which more stands.
  double most_left_m() const;
  /// Of some nails, asked or not, those that the cutter comes to along a direction. Throws Cancelled.
  std::vector<std::uint32_t> come_to(const std::vector<std::uint32_t>& nails, std::size_t direction);
  /// Does the ball rest beside it?
  bool is_beside(std::size_t nail) const { return !aside_[nail].isZero(0); }
  double cosine(std::size_t nail, std::size_t direction) const { return nails_[nail].normal.dot(frames_[direction].w); }
  /// Of the ball at rest on a nail, or beside it (tool frame).
  Vec3 middle_over(std::size_t nail, const ToolFrame& frame) const {
    return middle_at({nail, aside_[nail].cast<double>(), 0}, frame);
  }
  Vec3 tip_at(std::size_t nail, const ToolFrame& frame) const {
    return middle_over(nail, frame) - Vec3(0, 0, radius_m_);
  }

 private:
  /// A ball's middle: from where it would touch the nail, but for the allowance, by `aside` (stock frame).
  struct Place {
    std::size_t nail;
    Vec3 aside;
    float leaves;  ///< above the nail (m), where the ball gets there
  };

  std::vector<std::uint32_t> look_along_all(const std::vector<Place>& places, double most_m);
  void keep_reached(std::vector<std::uint32_t>& asked, const std::vector<Place>& places, double most_m,
                    std::size_t direction);
  /// A nail counts as reached where the cutter would leave no more.
  double reached_m() const;
  Vec3 middle_at(const Place& place, const ToolFrame& frame) const;
  bool leaves_no_more(double most_m, const Place& place, const Site& site, const FacetColumns& columns) const;
  double highest_above(double aside, double most_m, double cosine) const;
  std::vector<Place> free_places() const;
  void add_free_places(std::size_t nail, const FreeBall& ball, std::vector<Place>& places) const;

  const MillJob& job_;
  PartViews& views_;
  Carver& carver_;
  const RunContext& run_;
  const Nails& nails_;
  double radius_m_;
  std::size_t stride_;
  std::vector<ToolFrame> frames_;
  std::vector<std::unique_ptr<Site>> sites_;
  std::vector<std::uint32_t> along_;    ///< of each nail, a bit for each direction
  std::vector<Eigen::Vector3f> aside_;  ///< of each nail, how far beside it the ball rests
  std::vector<float> leaves_;           ///< of each nail, what a ball beside it leaves, and a little
};

}  // namespace sculpt
