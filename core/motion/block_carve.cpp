#include "core/motion/block_carve.hpp"

#include <algorithm>
#include <span>

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

class BlockCarve {
 public:
  BlockCarve(Arm& arm, const Block& block, int effort) : arm_(arm), block_(block), effort_(effort) {}

  BlockTrial run() {
    while (step()) ++removed_;
    return {removed_, static_cast<int>(standing().size()), arm_.at()};
  }

 private:
  const Material& material() const { return arm_.scene().material(); }

  bool step() { return step_to_neighbour() || step_within_axis() || step_with_new_axis(); }

  bool step_to_neighbour() {
    std::vector<Candidate> near;
    for (Voxel step : face_steps) {
      const Voxel v = arm_.at() + step;
      if (block_.contains(v) && material().contains(v) && arm_.holds_nothing(v)) near.push_back({cost(v), v});
    }
    std::sort(near.begin(), near.end());
    return std::any_of(near.begin(), near.end(), [&](const Candidate& c) { return arm_.cut_neighbour(c.voxel); });
  }

  bool step_within_axis() {
    const std::vector<Candidate> all = candidates();
    return std::any_of(all.begin(), all.end(), [&](const Candidate& c) { return arm_.cut_after_hop(c.voxel); });
  }

  /// Tries the axes by how many of the open voxels they could come down to.
  bool step_with_new_axis() {
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
    for (const Choice& choice : choices) {
      const std::size_t most = std::min(choice.voxels.size(), transits_an_axis[effort_]);
      if (arm_.cut_after_transit(std::span(choice.voxels).first(most), choice.axis, effort_)) return true;
    }
    return false;
  }

  std::vector<Voxel> standing() const {
    std::vector<Voxel> voxels;
    for (int k = 0; k < block_.size; ++k)
      for (int j = 0; j < block_.size; ++j)
        for (int i = 0; i < block_.size; ++i)
          if (const Voxel v = block_.corner + Voxel{i, j, k}; material().contains(v)) voxels.push_back(v);
    return voxels;
  }

  std::vector<Candidate> candidates() const {
    std::vector<Candidate> all;
    for (Voxel v : standing())
      if (is_open(material(), v) && arm_.holds_nothing(v)) all.push_back({cost(v), v});
    std::sort(all.begin(), all.end());
    return all;
  }

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

  Arm& arm_;
  const Block& block_;
  int effort_;
  int removed_ = 0;
};

}  // namespace

BlockTrial carve_block(Arm& arm, const Block& block, int effort) {
  return BlockCarve(arm, block, effort).run();
}

}  // namespace sculpt
