// One file above 300 lines: Highway compiles it anew for each kind of vectors, and what is in it together.
#include "core/sweep/field/posture_lanes.hpp"

#include "core/trajectory/quantum.hpp"

// Lanes are kept in arrays of vectors, which vectors of unknown size do not allow.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/sweep/field/posture_lanes.cpp"
#include <hwy/foreach_target.h>
// Highway wants this order.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sculpt {
namespace HWY_NAMESPACE {
namespace {

// Products and sums are rounded one by one (no fused operations), so that all targets give the same bits.
namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<double, lane_count>;
using V = hn::Vec<D>;
using Mask = hn::Mask<D>;
constexpr D d;

HWY_INLINE V all(double value) {
  return hn::Set(d, value);
}

struct V3 {
  V x, y, z;
};
HWY_INLINE V3 operator+(const V3& a, const V3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
HWY_INLINE V3 operator-(const V3& a, const V3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
HWY_INLINE V3 operator*(const V3& a, V s) {
  return {a.x * s, a.y * s, a.z * s};
}
HWY_INLINE V3 cross(const V3& a, const V3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
HWY_INLINE V length(const V3& a) {
  return hn::Sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
}
HWY_INLINE V3 zero3() {
  return {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
}

/// 1.5 * 2^52: added to a number below 2^51 it leaves the nearest whole number in the lowest bits.
constexpr double whole = 6755399441055744.0;

/// 1 / n! with a sign that changes every two.
constexpr double taylor(int n) {
  double factorial = n / 2 % 2 ? -1 : 1;
  for (int m = 2; m <= n; ++m) factorial *= m;
  return 1 / factorial;
}

/// Within 2^-52 of the true values up to 10^5: reduction by multiples of pi/2 in two parts (Cody and Waite), then
/// Taylor's series on +-pi/4, whose first term left out is below 2^-54.
HWY_INLINE void sine_cosine(V x, V& sine, V& cosine) {
  constexpr double quarter_turn = 0x1.921fb544p+0;             // 33 bits of pi/2: times a whole number it is exact
  constexpr double quarter_turn_rest = 0x1.0b4611a626331p-34;  // pi/2 less that
  const V shifted = x * all(2 / 3.14159265358979323846) + all(whole);
  const V quarters = shifted - all(whole);
  const V r = x - quarters * all(quarter_turn) - quarters * all(quarter_turn_rest);
  const V rr = r * r;
  V s = all(taylor(15)), c = all(taylor(16));
  for (int n = 13; n >= 3; n -= 2) s = s * rr + all(taylor(n));
  for (int n = 14; n >= 2; n -= 2) c = c * rr + all(taylor(n));
  s = s * rr * r + r;
  c = c * rr + all(1);
  const hn::RebindToUnsigned<D> du;
  const auto count = hn::BitCast(du, shifted);
  const auto one = hn::Set(du, 1), two = hn::Set(du, 2);
  const Mask odd = hn::MaskFromVec(hn::BitCast(d, hn::VecFromMask(du, hn::TestBit(count, one))));
  const V sine_sign = hn::BitCast(d, hn::ShiftLeft<62>(hn::And(count, two)));
  const V cosine_sign = hn::BitCast(d, hn::ShiftLeft<62>(hn::And(count + one, two)));
  sine = hn::Xor(hn::IfThenElse(odd, c, s), sine_sign);
  cosine = hn::Xor(hn::IfThenElse(odd, s, c), cosine_sign);
}

/// Columns of a rotation and an origin.
struct Pose {
  V3 x, y, z, at;
};
HWY_INLINE V3 turned(const Pose& pose, const double* v) {
  return pose.x * all(v[0]) + pose.y * all(v[1]) + pose.z * all(v[2]);
}
HWY_INLINE Pose operator*(const Pose& pose, const PostureLanes::Fixed& fixed) {
  const double* r = fixed.rotation.data();
  return {turned(pose, r), turned(pose, r + 3), turned(pose, r + 6), pose.at + turned(pose, fixed.origin.data())};
}
HWY_INLINE Pose start_of(const PostureLanes::Program& program) {
  const auto vector = [](const double* v) HWY_ATTR { return V3{all(v[0]), all(v[1]), all(v[2])}; };
  const double* r = program.start.rotation.data();
  return {vector(r), vector(r + 3), vector(r + 6), vector(program.start.origin.data())};
}
HWY_INLINE void turn_about_z(Pose& pose, V angle) {
  V s, c;
  sine_cosine(angle, s, c);
  const V3 x = pose.x;
  pose.x = x * c + pose.y * s;
  pose.y = pose.y * c - x * s;
}

/// Per joint: velocity of the ball and angular velocity.
struct Jacobian {
  V3 ball[max_joints], turn[max_joints];
};

/// Pose of the tool: its origin is the ball, its z points from the spindle to the ball.
HWY_INLINE Pose tool_pose(const PostureLanes::Program& program, const V* q, Jacobian* jacobian) {
  if (jacobian)
    for (std::size_t c = 0; c < program.lower.size(); ++c) jacobian->ball[c] = jacobian->turn[c] = zero3();
  Pose pose = start_of(program);
  for (const PostureLanes::Move& move : program.moves) {
    const V value = q[move.coordinate] * all(move.multiplier) + all(move.offset);
    if (jacobian) {
      const V3 rate = pose.z * all(move.multiplier);
      V3 &ball = jacobian->ball[move.coordinate], &turn = jacobian->turn[move.coordinate];
      if (move.turns) {
        // rate x (ball - origin): the part with the ball is added at the end, when the ball is known.
        ball = ball + cross(pose.at, rate);
        turn = turn + rate;
      } else {
        ball = ball + rate;
      }
    }
    if (move.turns) {
      turn_about_z(pose, value);
    } else {
      pose.at = pose.at + pose.z * value;
    }
    pose = pose * move.after;
  }
  if (jacobian)
    for (std::size_t c = 0; c < program.lower.size(); ++c)
      jacobian->ball[c] = jacobian->ball[c] + cross(jacobian->turn[c], pose.at);
  return pose;
}

constexpr int rows = 5;

/// How far the tool is from where it should be: position, then the turning about x and y that brings the tool's axis
/// onto z.
struct TaskError {
  V row[rows];
};
HWY_INLINE TaskError task_error(const Pose& pose, const V3& ball) {
  return {{ball.x - pose.at.x, ball.y - pose.at.y, ball.z - pose.at.z, hn::Neg(pose.z.y), pose.z.x}};
}

/// J J^T + 1e-12 as L D L^T.
struct Normal {
  V column[max_joints][rows];
  V lower[rows][rows], inverse[rows];
};
HWY_INLINE void factorize(const Jacobian& jacobian, std::size_t dof, Normal& normal) {
  V square[rows][rows];
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j <= i; ++j) square[i][j] = all(i == j ? 1e-12 : 0);
  for (std::size_t c = 0; c < dof; ++c) {
    const V3 &ball = jacobian.ball[c], &turn = jacobian.turn[c];
    V* column = normal.column[c];
    column[0] = ball.x, column[1] = ball.y, column[2] = ball.z, column[3] = turn.x, column[4] = turn.y;
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j <= i; ++j) square[i][j] = square[i][j] + column[i] * column[j];
  }
  for (int j = 0; j < rows; ++j) {
    V scaled[rows], diagonal = square[j][j];
    for (int k = 0; k < j; ++k) {
      scaled[k] = square[j][k];  // L times D: divided by D only when the row is used up
      diagonal = diagonal - normal.lower[j][k] * scaled[k];
    }
    normal.inverse[j] = all(1) / diagonal;
    for (int i = j + 1; i < rows; ++i) {
      V entry = square[i][j];
      for (int k = 0; k < j; ++k) entry = entry - normal.lower[i][k] * scaled[k];
      square[i][j] = entry;
      normal.lower[i][j] = entry * normal.inverse[j];
    }
  }
}
/// Weights of the rows.
HWY_INLINE void substitute(const Normal& normal, TaskError& rhs) {
  for (int i = 1; i < rows; ++i)
    for (int k = 0; k < i; ++k) rhs.row[i] = rhs.row[i] - normal.lower[i][k] * rhs.row[k];
  for (int i = 0; i < rows; ++i) rhs.row[i] = rhs.row[i] * normal.inverse[i];
  for (int i = rows - 1; i >= 0; --i)
    for (int k = i + 1; k < rows; ++k) rhs.row[i] = rhs.row[i] - normal.lower[k][i] * rhs.row[k];
}

constexpr double max_step = 0.3;  // rad or m; a longer one means that the guess was not close
constexpr double fading = 0.05;   // m and rad: below this task error the null space motion fades

/// The motion towards the goal for one step. What it does to the tool is taken from `rest`, so that the step after it
/// makes good for it: what remains is the motion in the null space of the Jacobian.
HWY_INLINE void null_space_step(const Normal& normal, std::size_t dof, const V* q, const NullSpaceGoal& goal,
                                TaskError& rest, V* secondary) {
  V square = hn::Zero(d);
  for (int i = 0; i < rows; ++i) square = square + rest.row[i] * rest.row[i];
  const V gain = all(goal.gain) * hn::Min(all(1), hn::Sqrt(square) * all(1 / fading));
  for (std::size_t c = 0; c < dof; ++c) {
    secondary[c] = gain * (all(goal.towards[static_cast<Eigen::Index>(c)]) - q[c]);
    for (int i = 0; i < rows; ++i) rest.row[i] = rest.row[i] - normal.column[c][i] * secondary[c];
  }
}

/// Least joint motion that takes off the task error, on top of `secondary`. False where it is too long.
HWY_INLINE Mask step(const Normal& normal, std::size_t dof, TaskError& rest, const V* secondary, V* q) {
  substitute(normal, rest);
  V longest = hn::Zero(d);
  Mask close = hn::Eq(longest, longest);
  for (std::size_t c = 0; c < dof; ++c) {
    V change = normal.column[c][0] * rest.row[0];
    for (int i = 1; i < rows; ++i) change = change + normal.column[c][i] * rest.row[i];
    if (secondary) change = change + secondary[c];
    close = hn::And(close, hn::Lt(hn::Abs(change), all(max_step)));
    q[c] = q[c] + change;
  }
  return close;
}

HWY_INLINE void solve_some(const PostureLanes::Program& program, int steps, const NullSpaceGoal* goal,
                           PostureBatch& batch, std::size_t lane) {
  const std::size_t dof = program.lower.size();
  V q[max_joints], secondary[max_joints];
  for (std::size_t c = 0; c < dof; ++c) q[c] = hn::Load(d, batch.q.joints[c].data() + lane);
  const V3 given{hn::Load(d, batch.ball_m[0].data() + lane), hn::Load(d, batch.ball_m[1].data() + lane),
                 hn::Load(d, batch.ball_m[2].data() + lane)};
  const double* r = program.towards_axis.data();
  const V3 ball{given.x * all(r[0]) + given.y * all(r[1]) + given.z * all(r[2]),
                given.x * all(r[3]) + given.y * all(r[4]) + given.z * all(r[5]),
                given.x * all(r[6]) + given.y * all(r[7]) + given.z * all(r[8])};

  Jacobian jacobian;
  Normal normal;
  Mask fine = hn::Eq(all(0), all(0));
  for (int done = 0; done < steps; ++done) {
    TaskError rest = task_error(tool_pose(program, q, &jacobian), ball);
    factorize(jacobian, dof, normal);
    if (goal) null_space_step(normal, dof, q, *goal, rest, secondary);
    fine = hn::And(fine, step(normal, dof, rest, goal ? secondary : nullptr, q));
  }
  TaskError rest = task_error(tool_pose(program, q, nullptr), ball);
  fine = hn::And(fine, step(normal, dof, rest, nullptr, q));

  for (std::size_t c = 0; c < dof; ++c) {
    const V quanta = q[c] * all(quanta_per_unit) + all(whole) - all(whole);
    q[c] = quanta / all(quanta_per_unit) + all(0);  // + 0 drops the sign of -0
    fine = hn::And(fine, hn::And(hn::Ge(q[c], all(program.lower[c])), hn::Le(q[c], all(program.upper[c]))));
    hn::Store(q[c], d, batch.q.joints[c].data() + lane);
  }
  const Pose pose = tool_pose(program, q, nullptr);
  const V3 off = pose.at - ball;
  const V3 turned_off{hn::Neg(pose.z.x), hn::Neg(pose.z.y), hn::Neg(pose.z.z) - all(1)};
  fine = hn::And(fine, hn::Lt(pose.z.z, hn::Zero(d)));
  const V none = all(std::numeric_limits<double>::infinity());
  const V ball_off = length(off), top_off = length(off + turned_off * all(program.stickout_m));
  hn::Store(hn::IfThenElse(fine, ball_off, none), d, batch.ball_off_m.data() + lane);
  hn::Store(hn::IfThenElse(fine, top_off, none), d, batch.top_off_m.data() + lane);
}

/// Of a frame that is carried outwards along a chain, by the share of the edge in place of time: its turning with two
/// derivatives, and the second and third derivative of the place of its origin.
struct Motion {
  V3 angular_velocity, angular_acceleration, angular_jerk, acceleration, jerk;
};
HWY_INLINE void carry(Motion& motion, const V3& arm) {
  const V3 moved = cross(motion.angular_velocity, arm),
           turned = cross(motion.angular_acceleration, arm) + cross(motion.angular_velocity, moved);
  motion.acceleration = motion.acceleration + turned;
  motion.jerk = motion.jerk + cross(motion.angular_jerk, arm) + cross(motion.angular_acceleration, moved) * all(2) +
                cross(motion.angular_velocity, turned);
}

/// Outward recursion of a serial chain's velocities (Craig, Introduction to Robotics, 5.6) without joint accelerations,
/// derived twice.
HWY_INLINE void derive_some(const PostureLanes::Program& program, EdgeBatch& edges, std::size_t lane) {
  Pose pose = start_of(program);
  Motion motion{zero3(), zero3(), zero3(), zero3(), zero3()};
  for (const PostureLanes::Move& move : program.moves) {
    const auto joint = static_cast<std::size_t>(move.coordinate);
    const V from = hn::Load(d, edges.from.joints[joint].data() + lane);
    const V rate = hn::Load(d, edges.to.joints[joint].data() + lane) - from;
    const V value = (from + all(0.5) * rate) * all(move.multiplier) + all(move.offset);
    const V3 moved = pose.z * (all(move.multiplier) * rate);
    // Of the joint's own motion, whose direction turns.
    const V3 acceleration_of_moved = cross(motion.angular_velocity, moved);
    const V3 jerk_of_moved =
        cross(motion.angular_acceleration, moved) + cross(motion.angular_velocity, acceleration_of_moved);
    if (move.turns) {
      motion.angular_jerk = motion.angular_jerk + jerk_of_moved;
      motion.angular_acceleration = motion.angular_acceleration + acceleration_of_moved;
      motion.angular_velocity = motion.angular_velocity + moved;
      turn_about_z(pose, value);
    } else {
      const V3 arm = pose.z * value;
      carry(motion, arm);
      motion.acceleration = motion.acceleration + acceleration_of_moved * all(2);
      motion.jerk = motion.jerk + jerk_of_moved * all(3);
      pose.at = pose.at + arm;
    }
    const V3 before = pose.at;
    pose = pose * move.after;
    carry(motion, pose.at - before);
  }
  hn::Store(length(motion.acceleration), d, edges.ball_second_derivative.data() + lane);
  hn::Store(length(motion.jerk), d, edges.ball_third_derivative.data() + lane);
  carry(motion, pose.z * all(-program.stickout_m));
  hn::Store(length(motion.acceleration), d, edges.top_second_derivative.data() + lane);
  hn::Store(length(motion.jerk), d, edges.top_third_derivative.data() + lane);
}

}  // namespace

void solve_lanes(const PostureLanes::Program& program, int steps, const NullSpaceGoal* goal, PostureBatch& batch) {
  for (std::size_t lane = 0; lane < lane_count; lane += hn::Lanes(d)) solve_some(program, steps, goal, batch, lane);
}

void derive_lanes(const PostureLanes::Program& program, EdgeBatch& edges) {
  for (std::size_t lane = 0; lane < lane_count; lane += hn::Lanes(d)) derive_some(program, edges, lane);
}

}  // namespace HWY_NAMESPACE
}  // namespace sculpt
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace sculpt {
namespace {

HWY_EXPORT(solve_lanes);
HWY_EXPORT(derive_lanes);

PostureLanes::Fixed fixed_of(const Frame& frame) {
  PostureLanes::Fixed fixed;
  Eigen::Map<Eigen::Matrix3d>(fixed.rotation.data()) = frame.linear();
  Eigen::Map<Vec3>(fixed.origin.data()) = frame.translation();
  return fixed;
}

}  // namespace

PostureLanes::PostureLanes(const Chain& chain, const Vec3& axis) {
  Eigen::Matrix3d towards_axis;
  towards_axis.row(0) = axis.unitOrthogonal();
  towards_axis.row(1) = axis.cross(Vec3(towards_axis.row(0)));
  towards_axis.row(2) = axis;
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(program_.towards_axis.data()) = towards_axis;
  const std::vector<Chain::Step>& steps = chain.steps();
  program_.start = fixed_of(Frame(towards_axis) * steps.front().before);
  for (std::size_t at = 0; at < steps.size(); ++at) {
    const Chain::Step& step = steps[at];
    const Frame& after = at + 1 < steps.size() ? steps[at + 1].before : chain.last();
    program_.moves.push_back({step.turns, step.coordinate, step.multiplier, step.offset, fixed_of(after)});
  }
  program_.lower.assign(chain.lower().begin(), chain.lower().end());
  program_.upper.assign(chain.upper().begin(), chain.upper().end());
  program_.stickout_m = chain.stickout_m();
}

void PostureLanes::solve(PostureBatch& batch, int steps, const NullSpaceGoal* goal) const {
  HWY_DYNAMIC_DISPATCH(solve_lanes)(program_, steps, goal, batch);
}

void PostureLanes::derive(EdgeBatch& edges) const {
  HWY_DYNAMIC_DISPATCH(derive_lanes)(program_, edges);
}

}  // namespace sculpt

#endif  // HWY_ONCE
