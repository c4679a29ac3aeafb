#include "core/motion/tool/tool_reach.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <optional>

#include "core/motion/tool/long_tool.hpp"

namespace sculpt {
namespace {

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
/// Sweeps through the whole grid are worth their while from one wanted voxel in so many on.
constexpr std::size_t sparse = 4096;

int steps_along(Voxel axis, double length) {
  return static_cast<int>(length / Vec3(axis.i, axis.j, axis.k).norm() + 0.5);
}

/// The voxels that a tool passes, from its ball's outwards: those beside each step of the ball.
struct ToolRay {
  ToolRay(Voxel axis, double length) : step(axis), steps(steps_along(axis, length)) {
    for (int part = 1; part < 8; ++part)
      if (const Voxel w{(part & 1) * axis.i, (part >> 1 & 1) * axis.j, (part >> 2) * axis.k};
          std::popcount(static_cast<unsigned>(part)) == l1(w, {}))
        beside.push_back(w);
  }

  Voxel step;
  int steps;
  std::vector<Voxel> beside;  ///< offsets whose components are each 0 or that of `step`, but 0 itself
};

/// Asks for each voxel with an open face, and each ray, what stands in the way, and again only once that is gone.
class ToolReach {
 public:
  ToolReach(const VoxelSet& standing, const std::vector<Voxel>& wanted, const std::vector<Voxel>& steps, double length)
      : standing_(standing),
        wanted_(wanted),
        states_(wanted.size(), State::buried),
        last_waiting_(wanted.size(), none) {
    for (const Voxel step : steps) rays_.emplace_back(step, length);
    const auto n = static_cast<std::size_t>(standing.n());
    row_ends_.resize(n * n);
    for (const Voxel v : wanted) ++row_ends_[row(v)];
    std::partial_sum(row_ends_.begin(), row_ends_.end(), row_ends_.begin());
  }

  std::vector<Voxel> run(const Watch& watch) {
    for (std::size_t number = 0; number < wanted_.size(); ++number) {
      if (watch.stop.stop_requested()) throw Cancelled{};
      const bool open = std::any_of(face_steps.begin(), face_steps.end(),
                                    [&](Voxel step) { return !stands(wanted_[number] + step); });
      if (open) look_around(number);
      tell();
    }
    std::vector<Voxel> left;
    for (std::size_t number = 0; number < wanted_.size(); ++number)
      if (states_[number] != State::gone) left.push_back(wanted_[number]);
    return left;
  }

 private:
  enum class State : char { buried, open, gone };
  /// A voxel that waits, along one ray, for another one to go.
  struct Waiting {
    std::size_t number, ray;
    int passed;          ///< steps along the ray that nothing is in the way of
    std::size_t before;  ///< who else waits for the same one
  };

  /// At first.
  bool stands(Voxel v) const { return Grid{standing_.n(), 1, Vec3::Zero()}.contains(v) && standing_.contains(v); }

  std::size_t row(Voxel v) const {
    return static_cast<std::size_t>(v.k) * static_cast<std::size_t>(standing_.n()) + static_cast<std::size_t>(v.j);
  }

  /// Of a wanted voxel, its place among them.
  std::optional<std::size_t> number_of(Voxel v) const {
    const std::size_t begin = row(v) == 0 ? 0 : row_ends_[row(v) - 1], end = row_ends_[row(v)];
    const auto first = wanted_.begin() + static_cast<std::ptrdiff_t>(begin),
               last = wanted_.begin() + static_cast<std::ptrdiff_t>(end);
    const auto at = std::ranges::lower_bound(first, last, v.i, {}, &Voxel::i);
    if (at == last || at->i != v.i) return std::nullopt;
    return static_cast<std::size_t>(at - wanted_.begin());
  }

  void look_around(std::size_t number) {
    if (states_[number] != State::buried) return;
    states_[number] = State::open;
    for (std::size_t ray = 0; ray < rays_.size(); ++ray) look(number, ray, 0);
  }

  /// Takes the voxel away if nothing is in the way along the ray; waits for what is, unless it stays.
  void look(std::size_t number, std::size_t which, int passed) {
    if (states_[number] == State::gone) return;
    const ToolRay& ray = rays_[which];
    const Grid grid{standing_.n(), 1, Vec3::Zero()};
    Voxel ball = wanted_[number] + ray.step * passed;
    for (int m = passed; m < ray.steps && grid.contains(ball); ++m, ball = ball + ray.step)
      for (const Voxel w : ray.beside) {
        if (!stands(ball + w)) continue;
        const auto blocker = number_of(ball + w);
        if (!blocker) return;
        if (states_[*blocker] == State::gone) continue;
        waiting_.push_back({number, which, m, last_waiting_[*blocker]});
        last_waiting_[*blocker] = waiting_.size() - 1;
        return;
      }
    states_[number] = State::gone;
    to_tell_.push_back(number);
  }

  void tell() {
    while (!to_tell_.empty()) {
      const std::size_t gone = to_tell_.back();
      to_tell_.pop_back();
      for (std::size_t at = last_waiting_[gone]; at != none;) {
        const Waiting waiting = waiting_[at];
        look(waiting.number, waiting.ray, waiting.passed);
        at = waiting.before;
      }
      for (const Voxel step : face_steps)
        if (stands(wanted_[gone] + step))
          if (const auto beside = number_of(wanted_[gone] + step)) look_around(*beside);
    }
  }

  const VoxelSet& standing_;
  const std::vector<Voxel>& wanted_;   ///< a voxel's number is its place here
  std::vector<std::size_t> row_ends_;  ///< of the voxels that share j and k: where those that are wanted end
  std::vector<ToolRay> rays_;
  std::vector<State> states_;
  std::vector<Waiting> waiting_;
  std::vector<std::size_t> last_waiting_;  ///< per voxel, who waits for it
  std::vector<std::size_t> to_tell_;       ///< voxels that are gone, of which those that wait for them do not know yet
};

/// Takes out of both sets what a tool without end comes to: sweeps along each of `steps` until they take nothing more.
void peel(VoxelSet& standing, std::vector<Voxel>& wanted, const std::vector<Voxel>& steps, const Watch& watch) {
  VoxelSet to_take(standing.n());
  for (const Voxel v : wanted) to_take.insert(v);
  for (std::size_t at = 0, in_vain = 0; in_vain < steps.size(); at = (at + 1) % steps.size()) {
    if (watch.stop.stop_requested()) throw Cancelled{};
    in_vain = peel_along(steps[at], to_take, standing) ? 1 : in_vain + 1;  // a second sweep along it takes nothing
  }
  std::erase_if(wanted, [&](Voxel v) { return !standing.contains(v); });
}

}  // namespace

std::vector<Voxel> find_out_of_tool_reach(const VoxelSet& standing, const std::vector<Voxel>& wanted,
                                          const std::vector<Voxel>& steps, double length, const Watch& watch) {
  const auto n = static_cast<std::size_t>(standing.n());
  if (n < 4 || wanted.size() < n * n * n / sparse) return ToolReach(standing, wanted, steps, length).run(watch);
  VoxelSet rest = standing;
  std::vector<Voxel> left = wanted;
  peel(rest, left, steps, watch);
  const bool ends_inside =
      std::ranges::any_of(steps, [&](Voxel step) { return static_cast<std::size_t>(steps_along(step, length)) < n; });
  return ends_inside ? ToolReach(rest, left, steps, length).run(watch) : left;
}

}  // namespace sculpt
