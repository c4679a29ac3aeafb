// What a window of the moving average that holds a corner may hold besides. Internal to core/timing.
#pragma once

#include <array>
#include <limits>

#include "core/timing/corner_cost.hpp"

namespace sculpt {

/// Of all windows that hold some corner, the one given first. Speeds are r', or by the tool in rad/s and m/s.
class WindowCorners {
 public:
  static constexpr std::size_t max_near = 64;  ///< corners that a window may reach, on one side

  double left = 1;  ///< of what may be strayed at any of them, less the parabolas' shares
  double acceleration = 0, turn_speed = 0;
  bool crowded = false;  ///< there are more than that

  /// A corner that is gone through at no more than `speed`, `at` (by r) from the first one. `cost` must outlive this.
  void add(const CornerCost& cost, double at, double speed);
  void add_edge(const PathEdge& edge, double speed);
  /// The parabola between two edges.
  void add_rise(const PathEdge& first, const PathEdge& second);

  /// The most that the corners' shares come to where the first one counts, the tool turning by up to `turned` (rad)
  /// between them and the window's mean. What the average strays at a corner is most where that mean is on its parabola
  /// and falls with the square of the way from there, to nothing at half of the farthest that a window reaches.
  double max_share(double turned, double window_s) const;
  /// How much faster (m/s) the ball may be where the mean of the joints is than it is at any time of the window: the
  /// Jacobian J changes within. With e the way from that mean and H the derivative of J, the mean of H(e, e') is the
  /// difference of H(e, e) at the window's ends, by 2 T: H(sum of both e, their difference) / 2 T. That sum is at most
  /// T / 2 times as much as q' differs from a constant one, half of what it changes by. The rest is of second order,
  /// |e| being at most T / 2 (1 - 2 x + 2 x^2) times the speed at a share x of the window.
  double feed_change(double window_s, const ToolRates& rates) const;

 private:
  double share(const CornerCost& cost, double turned) const;
  double share_at(double mean, double reach, double turned) const;

  struct Corner {
    const CornerCost* cost;
    double at;
  };
  std::array<Corner, 2 * max_near + 1> corners_;
  std::size_t count_ = 0;
  double room_m_ = std::numeric_limits<double>::infinity();  // the least that the tool may stray at any of them
  double fastest_ = 0, travel_speed_ = 0;
  double turn_rise_ = 0, travel_rise_ = 0;      // the most that turn_speed and travel_speed_ rise by in a second
  double turn_change_ = 0, travel_change_ = 0;  // and that they change by at all corners
};

}  // namespace sculpt
