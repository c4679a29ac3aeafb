#include "core/motion/gantry.hpp"

#include <string>

#include "core/base/error.hpp"
#include "core/motion/line.hpp"

namespace sculpt {
namespace {

int sign(int x) {
  return (x > 0) - (x < 0);
}

Voxel direction(Voxel from, Voxel to) {
  return {sign(to.i - from.i), sign(to.j - from.j), sign(to.k - from.k)};
}

std::string text(Voxel v) {
  return "(" + std::to_string(v.i) + ", " + std::to_string(v.j) + ", " + std::to_string(v.k) + ")";
}

}  // namespace

Gantry::Gantry(Scene& scene, const Configuration& home, Voxel entry, Emit emit, std::uint64_t known)
    : scene_(scene), home_(home), q_(home), at_(entry), emit_(std::move(emit)), known_(known) {}

Contact Gantry::certify(const Configuration& from, const Configuration& to, std::optional<Voxel> exempt) const {
  return known_ > 0 ? Contact::none : scene_.certify(from, to, exempt);
}

void Gantry::emit(const Keyframe& keyframe) {
  if (known_ == 0) return emit_(keyframe);
  --known_;
}

Configuration Gantry::configuration_at(Voxel voxel) const {
  const auto q = solve_rounded(scene_.chain(), {scene_.grid().centre(voxel), {}}, q_);
  if (!q)
    throw InputError("stock_out_of_reach",
                     "the joints do not reach voxel " + text(voxel) +
                         " (one beside the stock counts): widen the joint limits of the cell or move the stock");
  return *q;
}

void Gantry::move(const Configuration& q) {
  if (certify(q_, q) != Contact::none)
    throw InputError("no_transit", "a straight travel near voxel " + text(at_) +
                                       " is not free of the room: keep one voxel around the stock clear of fixtures");
  emit({q, false, {}, {}});
  q_ = q;
}

void Gantry::follow(const VoxelRun& run) {
  if (!entered_) move(configuration_at(at_));
  entered_ = true;
  if (!run.cut) {
    move(configuration_at(run.last));
    at_ = run.last;
    return;
  }
  const Voxel along = direction(run.first, run.last);
  if (run.first != run.last && at_ + along != run.first) {
    cut(run.first, run.first);
    cut(run.first + along, run.last);
  } else {
    cut(run.first, run.last);
  }
}

void Gantry::cut(Voxel first, Voxel last) {
  const Configuration from = q_, to = configuration_at(last), step = to - from;
  const Voxel along = direction(at_, first);
  const int count = l1(first, last) + 1;
  for (int m = 1; m <= count; ++m) {
    const Voxel voxel = first + along * (m - 1);
    const Configuration here = from + step * (static_cast<double>(m - 1) / count);
    const Configuration there = m == count ? to : from + step * (static_cast<double>(m) / count);
    if (certify(here, there, voxel) != Contact::none)
      throw InputError("no_transit",
                       "voxel " + text(voxel) +
                           " cannot be cut without touching the room: check the floor and fixtures of the cell");
    scene_.remove(voxel);
  }
  q_ = to;
  at_ = last;
  emit({q_, true, first, last});
}

void Gantry::go_home() {
  if (q_ != home_) move(home_);
}

}  // namespace sculpt
