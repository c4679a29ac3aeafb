#include "core/place/arm/free_cells.hpp"

#include <algorithm>
#include <cmath>

#include "core/collision/clearance.hpp"
#include "core/collision/shape/motion_bound.hpp"

namespace sculpt {
namespace {

constexpr double edge = 0.04;  // of a cell: rad or m
constexpr std::size_t max_axes = 2;
constexpr double max_cells = 200000;

}  // namespace

FreeCells::FreeCells(const Chain& chain, const Body& first, const Body& second, double margin_m)
    : first_(first), second_(second), reach_m_(margin_m) {
  const Configuration speed = approach_bound(chain, {first.link, first.extent_m}, {second.link, second.extent_m});
  double cells = 1;
  for (Eigen::Index c = 0; c < speed.size(); ++c) {
    if (speed[c] == 0) continue;
    const double count = std::ceil((chain.upper()[c] - chain.lower()[c]) / edge);
    cells *= count;
    if (axes_.size() == max_axes || !(cells <= max_cells)) return;
    axes_.push_back({c, chain.lower()[c], std::max(1, static_cast<int>(count))});
    reach_m_ += speed[c] * edge / 2;
  }
  cells_ = std::make_unique<std::atomic<std::uint8_t>[]>(static_cast<std::size_t>(std::max(1.0, cells)));
}

bool FreeCells::is_free(const Chain& chain, const Configuration& q) const {
  std::size_t number = 0;
  Configuration middle = q;
  for (const Axis& axis : axes_) {
    const int at = std::clamp(static_cast<int>((q[axis.coordinate] - axis.low) / edge), 0, axis.cells - 1);
    middle[axis.coordinate] = axis.low + (at + 0.5) * edge;
    if (std::abs(middle[axis.coordinate] - q[axis.coordinate]) > 0.5 * edge) return false;  // beyond the limits
    number = number * static_cast<std::size_t>(axis.cells) + static_cast<std::size_t>(at);
  }
  std::uint8_t state = cells_[number].load(std::memory_order_relaxed);
  if (state == unknown) {
    state = look(chain, middle);
    cells_[number].store(state, std::memory_order_relaxed);
  }
  return state == free;
}

FreeCells::State FreeCells::look(const Chain& chain, Configuration q) const {
  std::vector<Frame> poses;
  chain.link_poses(q, poses);
  const auto pose = [&](const Body& body) -> const Frame& { return poses[static_cast<std::size_t>(body.link)]; };
  return near_body(first_, pose(first_), second_, pose(second_), reach_m_) ? not_sure : free;
}

}  // namespace sculpt
