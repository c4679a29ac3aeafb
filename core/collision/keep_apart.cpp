#include "core/collision/keep_apart.hpp"

#include <algorithm>

namespace sculpt {
namespace {

using Node = ShapeTree::Node;
using HalfSpace = Bubble::HalfSpace;

constexpr int max_looks = 1000;              // at pairs of nodes
constexpr std::size_t max_half_spaces = 96;  // more make every question of a bubble slow

class Search {
 public:
  Search(const RelativeMotion& motion, double margin_m, const std::vector<Configuration>& wanted,
         std::vector<HalfSpace>& kept)
      : motion_(motion), margin_m_(margin_m), wanted_(wanted), kept_(kept) {}

  bool look_at(const ShapeTree& mover, const ShapeTree& other) {
    mover_ = &mover;
    other_ = &other;
    return look_at(mover.root(), mover.root().shape.placed(motion_.pose), other.root());
  }

 private:
  bool look_at(const Node& one, const Convex& placed, const Node& other) {
    const double enough = motion_.reach_m + margin_m_;
    const Separation plane = separate(placed, other.shape, enough, effort(one.is_leaf() && other.is_leaf()));
    if (plane.gap >= enough) return true;
    if (looks_left_-- == 0) return false;
    if (plane.gap > margin_m_ + motion_.remainder_m && keep(placed, plane)) return true;
    if (one.is_leaf() && other.is_leaf()) return false;
    if (other.is_leaf() || (!one.is_leaf() && one.shape.extent() >= other.shape.extent())) {
      for (int child = 0; child < one.children; ++child) {
        const Node& below = mover_->nodes[static_cast<std::size_t>(one.first_child + child)];
        if (!look_at(below, below.shape.placed(motion_.pose), other)) return false;
      }
    } else {
      for (int child = 0; child < other.children; ++child)
        if (!look_at(one, placed, other_->nodes[static_cast<std::size_t>(other.first_child + child)])) return false;
    }
    return true;
  }

  /// The points of the shape that the plane has to hold back; false if it does not at what is wanted.
  bool keep(const Convex& placed, const Separation& plane) {
    const std::size_t before = kept_.size();
    const Convex::Corners corners = placed.corners();
    const Configuration shift = motion_.velocity.transpose() * plane.normal;
    const double room_m = -plane.second_to - margin_m_ - motion_.remainder_m - corners.radius;
    for (std::size_t at = 0; at < corners.count; ++at) {
      const Vec3& point = corners.points[at];
      HalfSpace half_space{shift, plane.normal.dot(point) + room_m};
      half_space.approach.noalias() += motion_.turn.transpose() * point.cross(plane.normal);
      half_space.approach = -half_space.approach;
      if (half_space.holds_box(motion_.half)) continue;
      if (half_space.room_m > 0 && kept_.size() < max_half_spaces &&
          std::ranges::all_of(wanted_, [&](const Configuration& step) { return half_space.holds(step); })) {
        kept_.push_back(std::move(half_space));
        continue;
      }
      kept_.resize(before);
      return false;
    }
    return true;
  }

  const RelativeMotion& motion_;
  double margin_m_;
  const std::vector<Configuration>& wanted_;
  std::vector<HalfSpace>& kept_;
  const ShapeTree *mover_ = nullptr, *other_ = nullptr;
  int looks_left_ = max_looks;
};

}  // namespace

Nearness keep_apart(const Body& mover, const RelativeMotion& motion, const Body& other, double margin_m,
                    const std::vector<Configuration>& wanted, std::vector<HalfSpace>& half_spaces) {
  const std::size_t before = half_spaces.size();
  std::vector<HalfSpace> kept;
  Search search(motion, margin_m, wanted, kept);
  for (const Body::Part& of_mover : mover.parts)
    for (const Body::Part& of_other : other.parts)
      if (!search.look_at(*of_mover.tree, *of_other.tree)) return Nearness::too_near;
  half_spaces.insert(half_spaces.end(), kept.begin(), kept.end());
  return half_spaces.size() == before ? Nearness::touch_nowhere : Nearness::kept_apart;
}

}  // namespace sculpt
