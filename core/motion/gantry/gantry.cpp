#include "core/motion/gantry/gantry.hpp"

#include "core/base/error.hpp"
#include "core/motion/line.hpp"
#include "core/motion/transit.hpp"

namespace sculpt {
namespace {

/// Of the search for a way in, where the straight one is not free.
constexpr int way_in_iterations = 2000;
constexpr double max_edge_m = 0.1;

}  // namespace

Gantry::Gantry(Scene& scene, const Configuration& home, std::uint64_t seed, std::stop_token stop, GantryStart start,
               const GantryListener& listener)
    : scene_(scene),
      home_(home),
      q_(home),
      seed_(seed),
      stop_(std::move(stop)),
      known_(std::move(start)),
      listener_(listener) {
  if (const auto box = reach()) scene_.settle(*box);
}

/// The joint values of all voxels and of those around them: a prismatic chain's are linear in the ball's position.
std::optional<JointBox> Gantry::reach() const {
  const int n = scene_.grid().n;
  const auto low = configuration_at({-1, -1, 0}), high = configuration_at({n, n, n});
  if (!low || !high) return std::nullopt;
  return JointBox{low->cwiseMin(*high), low->cwiseMax(*high)};
}

bool Gantry::is_free(const Configuration& from, const Configuration& to, std::optional<Voxel> exempt) const {
  return emitted_ < known_.keyframes || scene_.certify(from, to, exempt) == Contact::none;
}

bool Gantry::is_free_run(const Configuration& from, const Configuration& to, const VoxelLine& run) const {
  return emitted_ < known_.keyframes || scene_.certify_run(from, to, run);
}

const Refusal* Gantry::known_refusal() const {
  const auto& refusals = known_.refusals;
  const bool is_next = refused_ < refusals.size() && refusals[refused_].keyframes == emitted_;
  return is_next ? &refusals[refused_] : nullptr;
}

Refusal Gantry::note_refusal(Voxel from, Voxel to) {
  const Refusal refusal{emitted_, from, to};
  if (refused_ >= known_.refusals.size()) listener_.refused(refusal);
  ++refused_;
  return refusal;
}

void Gantry::emit(const Keyframe& keyframe) {
  if (++emitted_ > known_.keyframes) return listener_.emit(keyframe);
  if (emitted_ == known_.keyframes) listener_.caught_up();
}

std::optional<Configuration> Gantry::configuration_at(Voxel voxel) const {
  return solve_rounded(scene_.chain(), {scene_.grid().centre(voxel), {}}, q_);
}

void Gantry::move(const Configuration& q) {
  emit({q, false, {}, {}});
  q_ = q;
}

void Gantry::enter() {
  const auto q = configuration_at(at_);
  if (q) way_in_ = plan_transit(scene_, home_, *q, seed_, stop_, {way_in_iterations, max_edge_m}).path;
  if (stop_.stop_requested()) throw Cancelled{};
  if (way_in_.empty()) throw note_refusal(at_, at_);
  for (std::size_t stop = 1; stop < way_in_.size(); ++stop) move(way_in_[stop]);
}

void Gantry::follow(const VoxelRun& run) {
  if (!entered()) enter();
  if (!run.cut) return travel(run.last);
  const Voxel along = sign(run.last - run.first);
  if (run.first != run.last && at_ + along != run.first) {
    cut(run.first, run.first);
    cut(run.first + along, run.last);
  } else {
    cut(run.first, run.last);
  }
}

void Gantry::travel(Voxel to) {
  if (const Refusal* known = known_refusal()) throw note_refusal(known->from, known->to);
  const auto q = configuration_at(to);
  if (!q || !is_free(q_, *q, {})) {
    const Voxel along = sign(to - at_);
    Voxel last = at_;
    for (Configuration before = q_; last + along != to; last = last + along) {
      const auto next = configuration_at(last + along);
      if (!next || !is_free(before, *next, {})) break;
      before = *next;
    }
    throw note_refusal(last, last + along);
  }
  move(*q);
  at_ = to;
}

void Gantry::keep_cut(const Configuration& q, Voxel first, Voxel last) {
  q_ = q;
  at_ = last;
  emit({q, true, first, last});
}

void Gantry::cut(Voxel first, Voxel last) {
  const Refusal* known = known_refusal();
  const Configuration from = q_;
  const auto to = configuration_at(last);
  const Configuration step = to.value_or(from) - from;
  const Voxel along = sign(first - at_);
  const int count = l1(first, last) + 1;
  if (to && count > 1 && known == nullptr && is_free_run(from, *to, {first, last})) {
    for (int m = 0; m < count; ++m) scene_.remove(first + along * m);
    return keep_cut(*to, first, last);
  }
  for (int m = 1; m <= count; ++m) {
    const Voxel voxel = first + along * (m - 1), before = voxel - along;
    const Configuration here = from + step * (static_cast<double>(m - 1) / count);
    const Configuration there = m == count && to ? *to : from + step * (static_cast<double>(m) / count);
    if (!to || (known != nullptr && known->to == voxel) || !is_free(here, there, voxel)) {
      const Refusal refusal = note_refusal(before, voxel);
      // Rounding moves what was certified until here by less than the margins.
      if (m > 1) keep_cut(configuration_at(before).value(), first, before);
      throw refusal;
    }
    scene_.remove(voxel);
  }
  keep_cut(*to, first, last);
}

void Gantry::go_home() {
  if (q_ == home_) return;
  if (scene_.certify(q_, home_) == Contact::none) return move(home_);
  // What was free is free: the way that it came by, backwards.
  if (q_ != way_in_.back() && scene_.certify(q_, way_in_.back()) != Contact::none)
    throw InputError("no_transit", "the robot finds no way home from where it came in: choose a home above the stock");
  if (q_ != way_in_.back()) move(way_in_.back());
  for (std::size_t stop = way_in_.size() - 1; stop-- > 0;) move(way_in_[stop]);
}

}  // namespace sculpt
