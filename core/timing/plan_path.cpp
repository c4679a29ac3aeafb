#include "core/timing/plan_path.hpp"

#include <algorithm>

#include "core/trajectory/reader.hpp"

namespace sculpt {
namespace {

PlanPath::Edge edge_of(const Keyframe& keyframe, std::uint64_t number, Voxel before) {
  PlanPath::Edge edge;
  edge.keyframe = static_cast<std::uint32_t>(number);
  edge.cut = keyframe.cut;
  if (!keyframe.cut || keyframe.mill) return edge;
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
  dof_ = header_.joints.size();
  add(header_.home, {});
  Configuration at = header_.home;
  Voxel cut_before{-9, -9, -9};
  int direction = MillStep{}.direction, tool = 0;
  while (const auto keyframe = reader.next()) {
    ++keyframes_;
    const auto removed = static_cast<std::uint32_t>(!keyframe->cut   ? 0
                                                    : keyframe->mill ? keyframe->mill->removed
                                                                     : run_length(*keyframe));
    if (keyframe->q != at) {
      Edge edge = edge_of(*keyframe, keyframes_, cut_before);
      edge.tool = static_cast<std::uint8_t>(tool);
      edge.placed = keyframe->mill && keyframe->mill->is_placed() && keyframe->mill->direction == direction;
      add(keyframe->q, edge);
    }
    edges_.back().removed += removed;
    at = keyframe->q;
    if (keyframe->cut) cut_before = keyframe->last;
    if (!keyframe->mill) continue;
    milled_.push_back({*keyframe->mill, edges_.size() - 1, keyframe->cut});
    direction = keyframe->mill->direction;
    if (!keyframe->mill->is_change()) continue;
    tool = keyframe->mill->tool;
    edges_.back().rest = true;
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

PlanMark mark_of(const PlanPath& path) {
  PlanMark mark;
  std::size_t point = 0;
  for (std::uint64_t keyframe = 1; keyframe <= path.keyframes(); ++keyframe) {
    if (point + 1 < path.size() && path.edge_to(point + 1).keyframe == keyframe) ++point;
    mark.add(path.configuration(point));
  }
  return mark;
}

}  // namespace sculpt
