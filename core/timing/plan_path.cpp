#include "core/timing/plan_path.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/trajectory/reader.hpp"

namespace sculpt {
namespace {

PlanPath::Edge edge_of(const Keyframe& keyframe, std::uint64_t number, Voxel before) {
  PlanPath::Edge edge;
  edge.keyframe = static_cast<std::uint32_t>(number);
  if (!keyframe.cut) return edge;
  edge.voxels = static_cast<std::uint16_t>(run_length(keyframe));
  edge.last = {static_cast<std::int16_t>(keyframe.last.i), static_cast<std::int16_t>(keyframe.last.j),
               static_cast<std::int16_t>(keyframe.last.k)};
  const Voxel way = keyframe.first == keyframe.last ? keyframe.last - before : sign(keyframe.last - keyframe.first);
  for (std::size_t at = 0; at < face_steps.size(); ++at)
    if (face_steps[at] == way) edge.way = static_cast<std::uint8_t>(at + 1);
  return edge;
}

}  // namespace

PlanPath::PlanPath(std::istream& in) {
  TrajectoryReader reader(in);
  header_ = reader.header();
  if (header_.mill)
    throw InputError(
        "trajectory_invalid",
        "the plan is for milling tools (format 2), of which no time law is made yet: take one of a thin tool");
  dof_ = header_.joints.size();
  add(header_.home, {});
  Configuration at = header_.home;
  Voxel cut_before{-9, -9, -9};
  while (const auto keyframe = reader.next()) {
    ++keyframes_;
    if (keyframe->q != at) add(keyframe->q, edge_of(*keyframe, keyframes_, cut_before));
    at = keyframe->q;
    if (keyframe->cut) cut_before = keyframe->last;
  }
}

Voxel PlanPath::voxel_of(std::size_t at, int m) const {
  const Edge& edge = edges_[at];
  const Voxel last{edge.last[0], edge.last[1], edge.last[2]};
  return edge.voxels == 1 ? last : last - face_steps[edge.way - 1u] * (edge.voxels - 1 - m);
}

void PlanPath::add(const Configuration& q, const Edge& edge) {
  if (edges_.size() % chunk == 0) chunks_.push_back(std::make_unique_for_overwrite<double[]>(chunk * dof_));
  std::copy(q.begin(), q.end(), chunks_.back().get() + edges_.size() % chunk * dof_);
  edges_.push_back(edge);
}

}  // namespace sculpt
