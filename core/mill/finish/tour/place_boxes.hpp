// Places in space, found by where they are.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/base/frame.hpp"

namespace sculpt {

/// In cubes of one size. The places must outlive it; immutable, any thread.
class PlaceBoxes {
 public:
  PlaceBoxes(const std::vector<Vec3>& places, double edge_m) : edge_(edge_m) {
    for (std::uint32_t at = 0; at < places.size(); ++at) boxes_[key(box_of(places[at]))].push_back(at);
  }

  /// Calls `visit(number)` with all places in boxes no more than `away` from that of `place`: those that are no farther
  /// than `away` edges are among them.
  template <typename Visit>
  void for_each_near(const Vec3& place, std::int64_t away, const Visit& visit) const {
    const Box middle = box_of(place);
    for (std::int64_t i = middle[0] - away; i <= middle[0] + away; ++i)
      for (std::int64_t j = middle[1] - away; j <= middle[1] + away; ++j)
        for (std::int64_t k = middle[2] - away; k <= middle[2] + away; ++k)
          if (const auto box = boxes_.find(key({i, j, k})); box != boxes_.end())
            for (const std::uint32_t at : box->second) visit(at);
  }

 private:
  using Box = std::array<std::int64_t, 3>;
  Box box_of(const Vec3& place) const {
    const auto along = [&](int axis) { return static_cast<std::int64_t>(std::floor(place[axis] / edge_)); };
    return {along(0), along(1), along(2)};
  }
  static std::uint64_t key(const Box& box) {
    constexpr std::int64_t half = 1 << 20;
    return static_cast<std::uint64_t>(box[0] + half) << 42 ^ static_cast<std::uint64_t>(box[1] + half) << 21 ^
           static_cast<std::uint64_t>(box[2] + half);
  }

  double edge_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> boxes_;
};

}  // namespace sculpt
