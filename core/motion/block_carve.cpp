#include "core/motion/block_carve.hpp"

#include <algorithm>

namespace sculpt {
namespace {

constexpr std::size_t transits_an_axis[] = {2, 4, 8};
/// Extra cost in voxel steps; together below 1, so that a nearer voxel always comes first.
constexpr double turn_cost = 0.5, inward_cost = 0.25;

bool is_open(const Material& material, Voxel v) {
  return std::any_of(face_steps.begin(), face_steps.end(), [&](Voxel step) {
    const Voxel near = v + step;
    return near.k >= 0 && !material.contains(near);
  });
}

struct Candidate {
  double cost;
  Voxel voxel;
  bool operator<(const Candidate& other) const { return cost != other.cost ? cost < other.cost : voxel < other.voxel; }
};

/// What stands of a block, as the arm would come to it where it is now.
class OpenVoxels {
 public:
  OpenVoxels(const Arm& arm, const Block& block) : arm_(arm), block_(block) {}

  std::vector<Voxel> standing() const {
    std::vector<Voxel> voxels;
    for (int k = 0; k < block_.size; ++k)
      for (int j = 0; j < block_.size; ++j)
        for (int i = 0; i < block_.size; ++i)
          if (const Voxel v = block_.corner + Voxel{i, j, k}; material().contains(v)) voxels.push_back(v);
    return voxels;
  }

  /// Those beside the one that the ball is in, the best first.
  std::vector<Candidate> neighbours() const {
    std::vector<Candidate> near;
    for (Voxel step : face_steps) {
      const Voxel v = arm_.at() + step;
      if (block_.contains(v) && material().contains(v) && arm_.holds_nothing(v)) near.push_back({cost(v), v});
    }
    std::sort(near.begin(), near.end());
    return near;
  }

  /// All, the best first.
  std::vector<Candidate> candidates() const {
    std::vector<Candidate> all;
    for (Voxel v : standing())
      if (is_open(material(), v) && arm_.holds_nothing(v)) all.push_back({cost(v), v});
    std::sort(all.begin(), all.end());
    return all;
  }

  /// Axes by how many of the voxels they could come down to.
  std::vector<Arm::Descent> descents(int effort) const {
    struct Choice {
      std::size_t axis;
      std::vector<Voxel> voxels;
    };
    const std::vector<Candidate> all = candidates();
    std::vector<Choice> choices;
    for (std::size_t axis = 0; axis < arm_.axes().size(); ++axis) {
      Choice choice{axis, {}};
      for (const Candidate& c : all)
        if (arm_.fits(c.voxel, axis)) choice.voxels.push_back(c.voxel);
      if (!choice.voxels.empty()) choices.push_back(std::move(choice));
    }
    std::stable_sort(choices.begin(), choices.end(),
                     [](const Choice& a, const Choice& b) { return a.voxels.size() > b.voxels.size(); });
    std::vector<Arm::Descent> descents;
    for (const auto& [axis, voxels] : choices)
      for (std::size_t i = 0; i < std::min(voxels.size(), transits_an_axis[effort]); ++i)
        descents.push_back({voxels[i], axis});
    return descents;
  }

 private:
  const Material& material() const { return arm_.scene().material(); }

  double cost(Voxel v) const {
    const Voxel step = v - arm_.at(), last = arm_.last_step();
    const int distance = l1(v, arm_.at());
    const bool in_line = step.i * last.j == step.j * last.i && step.j * last.k == step.k * last.j &&
                         step.k * last.i == step.i * last.k && step.i * last.i + step.j * last.j + step.k * last.k > 0;
    return distance + (in_line ? 0 : turn_cost) + (leads_inward(step) ? inward_cost : 0);
  }

  /// Against the outward normal of a face of the block that is open.
  bool leads_inward(Voxel step) const {
    return std::any_of(face_steps.begin(), face_steps.end(), [&](Voxel normal) {
      if (step.i * normal.i + step.j * normal.j + step.k * normal.k >= 0) return false;
      const Voxel middle = block_.corner + Voxel{block_.size / 2, block_.size / 2, block_.size / 2};
      const int out = block_.size / 2 + 1;
      const Voxel beyond = middle + normal * out;
      return beyond.k >= 0 && !material().contains(beyond);
    });
  }

  const Arm& arm_;
  const Block& block_;
};

}  // namespace

BlockTrial carve_block(Arm& arm, const Block& block, int effort) {
  const OpenVoxels open(arm, block);
  const auto step = [&] {
    const auto cut_one_of = [](const std::vector<Candidate>& all, const auto& cut) {
      return std::any_of(all.begin(), all.end(), [&](const Candidate& c) { return cut(c.voxel); });
    };
    return cut_one_of(open.neighbours(), [&](Voxel v) { return arm.cut_neighbour(v); }) ||
           cut_one_of(open.candidates(), [&](Voxel v) { return arm.cut_after_hop(v); }) ||
           arm.cut_after_transit(open.descents(effort), effort);
  };
  int removed = 0;
  while (step()) ++removed;
  return {removed, static_cast<int>(open.standing().size()), arm.at()};
}

std::vector<Arm::Descent> find_descents(const Arm& arm, const Block& block, int effort) {
  return OpenVoxels(arm, block).descents(effort);
}

}  // namespace sculpt
