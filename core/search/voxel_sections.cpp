#include "core/search/voxel_sections.hpp"

#include <algorithm>
#include <tuple>

namespace sculpt {
namespace {

/// Scanline fill: takes whole runs along x, so that it holds one seed a run and not one a voxel.
class Fill {
 public:
  Fill(int n, VoxelTree& waiting, VoxelTree& section)
      : grid_{n, 1, Vec3::Zero()}, waiting_(waiting), section_(section) {}

  std::vector<Voxel> run(Voxel seed, const std::function<void()>& tick) {
    seeds_.push_back(seed);
    while (!seeds_.empty()) {
      tick();
      const Voxel next = seeds_.back();
      seeds_.pop_back();
      if (waiting_.contains(next)) take_run(next);
    }
    return std::move(outer_);
  }

 private:
  bool is_waiting(Voxel v) const { return grid_.contains(v) && waiting_.contains(v); }

  void take_run(Voxel v) {
    while (is_waiting(v - face_steps[1])) v = v - face_steps[1];
    std::array<bool, 6> seeded{};  // by face: the run beside has its seed
    for (; is_waiting(v); v = v + face_steps[1]) {
      waiting_.erase(v);
      section_.insert(v);
      const int last = grid_.n - 1;
      if (std::min(v.i, v.j) == 0 || std::max({v.i, v.j, v.k}) == last) outer_.push_back(v);
      for (std::size_t face = 2; face < 6; ++face) {
        const bool beside = is_waiting(v + face_steps[face]);
        if (beside && !seeded[face]) seeds_.push_back(v + face_steps[face]);
        seeded[face] = beside;
      }
    }
  }

  Grid grid_;
  VoxelTree& waiting_;
  VoxelTree& section_;
  std::vector<Voxel> seeds_, outer_;
};

}  // namespace

std::vector<Voxel> take_section(int n, Voxel seed, VoxelTree& waiting, VoxelTree& section,
                                const std::function<void()>& tick) {
  return Fill(n, waiting, section).run(seed, tick);
}

Voxel find_start(int n, const std::vector<Voxel>& outer, Voxel from) {
  const auto rank = [&](Voxel v) {
    const int to_corner = std::min(v.i, n - 1 - v.i) + std::min(v.j, n - 1 - v.j) + std::min(v.k, n - 1 - v.k);
    return std::tuple(to_corner, l1(v, from), v.k, v.j, v.i);
  };
  return *std::min_element(outer.begin(), outer.end(), [&](Voxel a, Voxel b) { return rank(a) < rank(b); });
}

}  // namespace sculpt
