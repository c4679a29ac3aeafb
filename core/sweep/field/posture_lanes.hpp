// Several postures or edges at once, by SIMD: the hot loops of sweeps.
//
// Eight problems lie side by side, one number of each in an array of eight: a lane is a problem.
//
//      lane          0      1      2     ...    7
//      ball_m[0]   0.101  0.102  0.103   ...  0.108     eight ball positions, 1 mm apart along x
//      q[0]        0.500  0.500  0.500   ...  0.500     in: one guess for all
//      q[0]        0.507  0.514  0.521   ...  0.557     out: with the ball there and the tool along the axis
//      ball_off_m   1e-8   1e-8   2e-8   ...   4e-8     how far off the rounded values leave it
//
// A step of Gauss-Newton of one lane: the task error e has 5 rows, position (m) and the turning that brings the axis
// right (rad). With the Jacobian J, 5 rows and a column per joint, the least joint motion that takes it off is J^T (J
// J^T)^-1 e: of an arm of seven joints, two freedoms are left over, and a NullSpaceGoal may use them. From a guess that
// is off by 0.05 the errors are about 0.05, 0.0025, 6e-6.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/cell/chain.hpp"

namespace sculpt {

/// Problems side by side, whatever the vectors of the machine hold.
inline constexpr int lane_count = 8;

/// One number per lane.
struct alignas(64) Lanes : std::array<double, lane_count> {
  Lanes() : std::array<double, lane_count>{} {}
};

/// One configuration per lane; as many joints are used as the chain has.
struct LaneConfigurations {
  std::array<Lanes, max_joints> joints;

  void set(int lane, const Configuration& q) {
    for (Eigen::Index c = 0; c < q.size(); ++c)
      joints[static_cast<std::size_t>(c)][static_cast<std::size_t>(lane)] = q[c];
  }
  Configuration get(int lane, int dof) const {
    Configuration q(dof);
    for (int c = 0; c < dof; ++c) q[c] = joints[static_cast<std::size_t>(c)][static_cast<std::size_t>(lane)];
    return q;
  }
};

/// Ball positions (m, stock frame) with guesses; what comes of them.
struct PostureBatch {
  std::array<Lanes, 3> ball_m;
  LaneConfigurations q;  ///< in: guesses; out: rounded as they are stored
  /// Out: how far ball and shank's end are from where they should be at the rounded configuration (m); infinite where
  /// there is none.
  Lanes ball_off_m, top_off_m;

  void set(int lane, const Vec3& ball, const Configuration& guess) {
    for (std::size_t row = 0; row < 3; ++row) ball_m[row][static_cast<std::size_t>(lane)] = ball[static_cast<int>(row)];
    q.set(lane, guess);
  }
  bool solved(int lane) const {
    return ball_off_m[static_cast<std::size_t>(lane)] < std::numeric_limits<double>::infinity();
  }
};

/// Joint-linear edges, and how curved the paths of the tool's ends are along them.
struct EdgeBatch {
  LaneConfigurations from, to;
  /// Out: lengths of the second and the third derivative of the place of ball and shank's end by the share s of the
  /// edge (0 at `from`, 1 at `to`), at its middle: m per s^2 and m per s^3.
  Lanes ball_second_derivative, top_second_derivative, ball_third_derivative, top_third_derivative;
};

/// Where a redundant chain should be if the tool leaves it free: a secondary task in the null space of the Jacobian
/// (Liegeois, "Automatic supervisory control of the configuration and behavior of multibody mechanisms", 1977). In each
/// step it goes by `gain` of the way towards these joint values, by less once the task error is below 0.05 (m and rad),
/// so that the tool gets where it should.
struct NullSpaceGoal {
  Configuration towards;
  double gain = 0;
};

/// The kinematics of a chain for one direction of the tool, laid out for many lanes. Every lane gives the same bits on
/// every machine, whatever stands in the others. Immutable: safe to share between threads.
class PostureLanes {
 public:
  /// `axis`: unit vector from the ball to the spindle, in the stock frame.
  PostureLanes(const Chain& chain, const Vec3& axis);

  /// `steps` of Gauss-Newton, 1 at least, each with the least joint motion (5 rows: position, axis), and a last one
  /// with the Jacobian of the one before: from near the solution an error e becomes about e^2 by each of the first, and
  /// the last one takes off a factor of about what the first error was. A lane is refused if a step is longer than 0.3
  /// (rad or m) in any joint, if the result is outside the limits or has the tool upside down. Whether it is exact
  /// enough is for the caller to see: that is what the distances are for.
  void solve(PostureBatch& batch, int steps = 1, const NullSpaceGoal* goal = nullptr) const;

  /// Derivatives in the middle of each edge, by the exact recursion along the chain; each edge on its own.
  void derive(EdgeBatch& edges) const;

  /// A frame: three columns of a rotation and an origin.
  struct Fixed {
    std::array<double, 9> rotation;
    std::array<double, 3> origin;
  };
  /// A turn about z or a shift along it by multiplier * q[coordinate] + offset; then the frame up to the next one.
  struct Move {
    bool turns;
    int coordinate;
    double multiplier, offset;
    Fixed after;
  };
  /// Frames are seen from one that is turned so that the tool's axis is its z: there the two rows of the axis are x and
  /// y of a turning.
  struct Program {
    std::array<double, 9> towards_axis;  ///< rows x, y, z
    Fixed start;
    std::vector<Move> moves;
    std::vector<double> lower, upper;
    double stickout_m;
  };

 private:
  Program program_;
};

}  // namespace sculpt
