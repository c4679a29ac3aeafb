#include "core/motion/arm.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/base/random.hpp"
#include "core/motion/line.hpp"
#include "core/motion/transit.hpp"

namespace sculpt {
namespace {

constexpr std::size_t max_hubs = 12;
/// Of RRTConnect, by effort.
constexpr int rrt_iterations[] = {150, 600, 3000};
/// Work on transits that may be in vain, in tests of configurations: at first, and more for each voxel that is cut.
constexpr std::uint64_t in_vain_at_first = 10'000'000, in_vain_a_voxel = 20'000;
constexpr std::uint64_t iterations_a_voxel = 50;  ///< of OMPL's searches in vain, more for each voxel that is cut
constexpr std::uint64_t tests_a_start = 12;       ///< what looking for an entry from one configuration costs, about
constexpr std::size_t descents_at_once = 8;

}  // namespace

Arm::Arm(Scene& scene, const PostureAtlas& atlas, const VoxelSet& may_fall, const Configuration& home,
         const RunContext& run, Emit emit)
    : scene_(scene),
      atlas_(atlas),
      support_(scene.material().solid(), may_fall),
      home_(home),
      run_(run),
      emit_(std::move(emit)),
      q_(home) {
  const int n = scene.grid().n;
  at_ = {n / 2, n / 2, n - 1};
  trail_ = {home};
}

bool Arm::fits(Voxel voxel, std::size_t axis) const {
  return scene_.tool_fits({centre(voxel), axes()[axis]}, voxel);
}

bool Arm::cut_neighbour(Voxel voxel) {
  if (memory_.outside || l1(voxel, at_) != 1 || !fits(voxel, memory_.axis)) return false;
  const auto q = solve_rounded(scene_.chain(), {centre(voxel), axes()[memory_.axis]}, q_);
  if (!q || scene_.certify(q_, *q, voxel) != Contact::none) return false;
  commit({}, *q, voxel);
  return true;
}

bool Arm::cut_after_hop(Voxel voxel) {
  if (run_.watch.stop.stop_requested()) throw Cancelled{};
  if (memory_.outside || !fits(voxel, memory_.axis)) return false;
  // Where the tool ends up does not depend on how far it is lifted.
  const auto q = solve_rounded(scene_.chain(), {centre(voxel), axes()[memory_.axis]}, q_);
  if (!q || scene_.contact_at(*q, voxel) != Contact::none) return false;
  const double h = scene_.grid().voxel_m;
  for (int lift = 1; lift <= 2 * scene_.grid().n; lift *= 2)
    if (hop(voxel, lift * h)) return true;
  return false;
}

bool Arm::hop(Voxel voxel, double lift_m) {
  const Vec3& axis = axes()[memory_.axis];
  const Vec3 here = scene_.chain().tool_pose(q_).ball_m, there = centre(voxel);
  const double height = std::max(here.dot(axis), there.dot(axis)) + lift_m;
  const Vec3 above_here = here + (height - here.dot(axis)) * axis,
             above_there = there + (height - there.dot(axis)) * axis;
  const int samples = 1 + static_cast<int>(2 * (above_there - above_here).norm() / scene_.grid().voxel_m);
  for (int s = 0; s <= samples; ++s)
    if (!scene_.tool_fits({above_here + s * (above_there - above_here) / samples, axis}, {})) return false;

  Path path{q_};
  for (const Vec3& ball : {above_here, above_there, beside(voxel, axis)}) {
    const auto piece = track_line(scene_, path.back(), ball, axis);
    if (!piece) return false;
    path.insert(path.end(), piece->begin(), piece->end());
  }
  const auto q = solve_rounded(scene_.chain(), {there, axis}, path.back());
  if (!q || scene_.certify(path.back(), *q, voxel) != Contact::none) return false;
  commit(shorten(scene_, path), *q, voxel);
  return true;
}

const Arm::Path& Arm::way_out() {
  if (!memory_.way_out.empty()) return memory_.way_out;
  memory_.way_out = {q_};
  if (memory_.outside) return memory_.way_out;
  const auto path =
      track_line(scene_, q_, outside(scene_.chain().tool_pose(q_).ball_m, axes()[memory_.axis]), axes()[memory_.axis]);
  if (path) {
    memory_.way_out.insert(memory_.way_out.end(), path->begin(), path->end());
  } else {
    memory_.way_out =
        shorten(scene_, Path(trail_.rbegin(), trail_.rend() - static_cast<std::ptrdiff_t>(memory_.last_outside)));
  }
  return memory_.way_out;
}

bool Arm::cut_after_transit(std::span<const Descent> descents, int effort) {
  // Mostly the first one does. Where it does not few others do, so that looking at several at once is no waste.
  for (std::size_t at_once = 1; !descents.empty(); at_once = descents_at_once) {
    const auto looked_at = descents.first(std::min(at_once, descents.size()));
    if (transit_to_one(looked_at, effort)) return true;
    descents = descents.subspan(looked_at.size());
  }
  return false;
}

bool Arm::is_in_vain() const {
  return memory_.in_vain > in_vain_at_first + in_vain_a_voxel * memory_.cut;
}

bool Arm::transit_to_one(std::span<const Descent> descents, int effort) {
  if (is_in_vain()) return false;
  std::vector<Approach> approaches(descents.size());
  run_.helpers.for_each_index(descents.size(), [&](std::size_t i) { approaches[i] = look_at(descents[i], effort); });
  for (Approach& approach : approaches) {
    const bool found = approach.entry.has_value();
    const std::uint64_t tests = scene_.checks();
    if (transit(approach, effort)) return true;
    // As if none was left out: it shall not matter what was known.
    const std::size_t seeds = approach.left_out + approach.tried;
    if (!found && seeds > 0) no_entry_[number_of(approach.voxel, approach.axis)] = {memory_.cut, effort, seeds};
    memory_.in_vain += scene_.checks() - tests + tests_a_start * seeds;
  }
  return false;
}

bool Arm::transit(Approach& approach, int effort) {
  int failures = 0;
  for (; approach.entry; find_next_entry(approach)) {
    const Entry& entry = *approach.entry;
    const Configuration& hub = entry.from_outside.front();
    const Path& out = way_out();
    const auto iterations = std::min<std::uint64_t>(rrt_iterations[effort], memory_.iterations_left);
    const Path across = cross(out.back(), hub, static_cast<int>(iterations));
    if (across.empty()) {
      if (++failures > 1 + 2 * effort) return false;
      continue;
    }
    Path& hubs = memory_.hubs[approach.axis];
    if (hubs.size() < max_hubs) hubs.push_back(hub);
    Path to_hub(out);
    to_hub.insert(to_hub.end(), across.begin() + 1, across.end());
    move(shorten(scene_, to_hub));
    memory_.last_outside = trail_.size() - 1;
    memory_.axis = approach.axis;
    commit(shorten(scene_, entry.from_outside), entry.cut, approach.voxel);
    return true;
  }
  return false;
}

Arm::Path Arm::cross(const Configuration& from, const Configuration& to, int iterations) {
  Transit transit = plan_transit(scene_, from, to, mix(run_.seed, memory_.queries++), run_.watch.stop, {iterations});
  if (transit.searched) ++memory_.ompl_calls;
  if (transit.searched && !transit.path.empty()) ++memory_.ompl_solved;
  if (transit.searched && transit.path.empty())
    memory_.iterations_left -= std::min<std::uint64_t>(iterations, memory_.iterations_left);
  return std::move(transit.path);
}

void Arm::move(const Path& moves) {
  for (const Configuration& q : moves) {
    if (q == q_) continue;
    const Keyframe keyframe{q, false, {}, {}};
    emit_(keyframe);
    stand_at(keyframe);
  }
}

void Arm::commit(const Path& moves, const Configuration& cut, Voxel voxel) {
  move(moves);
  const Keyframe keyframe{cut, true, voxel, voxel};
  emit_(keyframe);
  stand_at(keyframe);
  ++memory_.cut;
  memory_.iterations_left += iterations_a_voxel;
  memory_.outside = false;
  memory_.way_out.clear();
}

void Arm::stand_at(const Keyframe& keyframe) {
  trail_.push_back(keyframe.q);
  q_ = keyframe.q;
  if (!keyframe.cut) return;
  scene_.remove(keyframe.first);
  support_.remove(keyframe.first);
  last_step_ = keyframe.first - at_;
  at_ = keyframe.first;
}

void Arm::resume(const std::vector<Keyframe>& keyframes, ArmMemory memory) {
  for (const Keyframe& keyframe : keyframes) stand_at(keyframe);
  memory_ = std::move(memory);
}

void Arm::go_home() {
  if (q_ == home_) return;
  Path path = way_out();
  Path across;
  for (int iterations : rrt_iterations)
    if (across.empty()) across = cross(path.back(), home_, iterations);
  if (run_.watch.stop.stop_requested()) throw Cancelled{};
  if (across.empty()) {
    path.assign(trail_.rbegin(), trail_.rend());
  } else {
    path.insert(path.end(), across.begin() + 1, across.end());
  }
  move(shorten(scene_, path));
  memory_.outside = true;
  memory_.way_out.clear();
  trail_ = {home_};
  memory_.last_outside = 0;
}

}  // namespace sculpt
