#include "bench/nearest_order.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <tuple>
#include <vector>

#include "core/material/cavities.hpp"
#include "core/search/run_writer.hpp"
#include "core/search/voxel_space.hpp"
#include "core/search/voxel_tree.hpp"

namespace sculpt {
namespace {

using Index = VoxelSpace::Index;

bool lower(Voxel a, Voxel b) {
  return std::tie(a.k, a.j, a.i) < std::tie(b.k, b.j, b.i);
}

class NearestOrder {
 public:
  NearestOrder(const VoxelGrid& voxels, const std::function<void(const VoxelRun&)>& emit, const Watch& watch)
      : watch_(watch),
        space_(voxels),
        standing_(voxels.n()),
        entered_(space_.index({voxels.n() + 1, voxels.n() + 1, voxels.n()}) + std::size_t{1}, unknown),
        writer_(translating_entry(voxels.n()), emit),
        home_(writer_.at()),
        at_(space_.index(home_)) {
    const VoxelSet enclosed = find_enclosed(voxels);
    const int n = voxels.n();
    for (int k = 0; k < n; ++k) {
      for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
          if (voxels.label({i, j, k}) != Label::remove || enclosed.contains({i, j, k})) continue;
          standing_.insert({i, j, k});
          ++total_;
        }
      }
    }
  }

  void run() {
    while (!standing_.empty()) {
      tick();
      if (!cut_beside()) travel(way_to_nearest());
    }
    const auto way = space_.find_way(at_, 0, [&](Voxel from, int) { return l1(from, home_); });
    travel(way.value());
    writer_.finish();
    watch_.step(Stage::plan, removed_, total_);
  }

 private:
  static constexpr std::uint8_t unknown = 255, origin = 254;

  void tick() {
    constexpr unsigned steps_a_report = 256;
    if (++ticks_ % steps_a_report == 0) watch_.step(Stage::plan, removed_, total_);
  }

  bool cut_beside() {
    constexpr std::array<int, 6> lowest_first{4, 2, 0, 1, 3, 5};
    for (int face : lowest_first) {
      if (!space_.is_remove(space_.beside(at_, face))) continue;
      at_ = space_.beside(at_, face);
      space_.open(at_);
      const Voxel voxel = space_.voxel(at_);
      standing_.erase(voxel);
      writer_.cut(voxel, voxel);
      ++removed_;
      return true;
    }
    return false;
  }

  void travel(const std::vector<std::uint8_t>& way) {
    for (int face : way) {
      at_ = space_.beside(at_, face);
      writer_.travel(space_.voxel(at_));
    }
  }

  /// To a place beside the nearest standing voxel. How long the way is comes from A*; which voxels are that near, from
  /// a flood of the voxels that lie on ways of that length.
  std::vector<std::uint8_t> way_to_nearest() {
    const auto distance = [&](Voxel from, int most) {
      tick();
      return standing_.distance(from, most);
    };
    const int length = static_cast<int>(space_.find_way(at_, 1, distance).value().size());
    flooded_.assign(1, at_);
    entered_[at_] = origin;
    std::size_t layer = 0;
    for (int steps = 1; steps <= length; ++steps)
      for (const std::size_t end = flooded_.size(); layer < end; ++layer) spread(flooded_[layer], length - steps + 1);

    std::vector<std::uint8_t> way = trace(lowest_of(layer));
    for (Index at : flooded_) entered_[at] = unknown;
    return way;
  }

  /// To the face neighbours in air that have a standing voxel `left` steps away or nearer.
  void spread(Index at, int left) {
    for (std::uint8_t face = 0; face < 6; ++face) {
      const Index next = space_.beside(at, face);
      if (!space_.is_air(next) || entered_[next] != unknown) continue;
      tick();
      if (standing_.distance(space_.voxel(next), left + 1) > left) continue;
      entered_[next] = face;
      flooded_.push_back(next);
    }
  }

  /// Of the places flooded from `first` on the one beside the lowest standing voxel, the first found.
  Index lowest_of(std::size_t first) const {
    std::optional<Voxel> lowest;
    Index place = at_;
    for (std::size_t f = first; f < flooded_.size(); ++f) {
      for (int face = 0; face < 6; ++face) {
        const Index next = space_.beside(flooded_[f], face);
        if (!space_.is_remove(next) || (lowest && !lower(space_.voxel(next), *lowest))) continue;
        lowest = space_.voxel(next);
        place = flooded_[f];
      }
    }
    return place;
  }

  std::vector<std::uint8_t> trace(Index to) const {
    std::vector<std::uint8_t> way;
    for (Index at = to; at != at_; at = space_.beside(at, way.back() ^ 1)) way.push_back(entered_[at]);
    std::reverse(way.begin(), way.end());
    return way;
  }

  const Watch& watch_;
  VoxelSpace space_;
  VoxelTree standing_;
  std::vector<std::uint8_t> entered_;  ///< by place: the face through which the running flood came
  std::vector<Index> flooded_;         ///< by rising number of steps
  RunWriter writer_;
  Voxel home_;
  Index at_;  ///< where the writer is
  unsigned ticks_ = 0;
  std::uint64_t removed_ = 0, total_ = 0;
};

}  // namespace

void carve_nearest(const VoxelGrid& voxels, const std::function<void(const VoxelRun&)>& emit, const Watch& watch) {
  NearestOrder(voxels, emit, watch).run();
}

}  // namespace sculpt
