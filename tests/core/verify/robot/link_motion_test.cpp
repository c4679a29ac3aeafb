#include "core/verify/robot/link_motion.hpp"

#include <gtest/gtest.h>

#include "tests/core/verify/small_cells.hpp"

namespace sculpt {
namespace {

Frame random_frame(Random& random, double reach) {
  Frame frame = Frame::Identity();
  const auto number = [&] { return random.between(-1, 1); };
  frame.translation() = reach * Vec3(number(), number(), number());
  frame.linear() = Eigen::Quaterniond(number(), number(), number(), number()).normalized().toRotationMatrix();
  return frame;
}

// A tree of ten links with joints of all kinds, one of them a mimic joint.
Cell random_cell(Random& random) {
  Cell cell;
  add_link(cell.robot, "link0", -1);
  for (int link = 1; link < 10; ++link) {
    Joint joint;
    joint.kind = static_cast<JointKind>(random.next() % 3);
    joint.origin = random_frame(random, 0.3);
    joint.axis = Vec3(random.between(-1, 1), random.between(-1, 1), random.between(0.1, 1)).normalized();
    joint.lower = -2;
    joint.upper = 2;
    add_link(cell.robot, "link" + std::to_string(link),
             static_cast<int>(random.next() % static_cast<std::uint64_t>(link)), joint);
    cell.rest.push_back(random.between(-1, 1));
  }
  cell.robot.joints[0].kind = JointKind::revolute;
  cell.robot.joints[8].kind = JointKind::revolute;
  cell.robot.joints[8].mimic = 0;
  cell.robot.joints[8].mimic_multiplier = -0.7;
  cell.robot.joints[8].mimic_offset = 0.2;
  return cell;
}

struct Sample {
  Random random;
  Cell cell;
  std::vector<int> joints;
  int stock;
  LinkMotion motion;
  Configuration from, step;

  explicit Sample(std::uint64_t seed)
      : random(seed),
        cell(random_cell(random)),
        joints(free_joints(cell.robot)),
        stock(static_cast<int>(random.next() % 10)),
        motion(cell.robot, joints, cell.rest, stock),
        from(joints.size()),
        step(joints.size()) {
    for (double& value : from) value = random.between(-2, 2);
    for (double& value : step) value = random.between(-0.7, 0.7);
  }
  static std::vector<int> free_joints(const Robot& robot) {
    std::vector<int> joints;
    for (std::size_t at = 0; at < robot.joints.size(); ++at)
      if (robot.joints[at].kind != JointKind::fixed && robot.joints[at].mimic < 0)
        joints.push_back(static_cast<int>(at));
    return joints;
  }
  std::vector<Frame> poses(double t) const {
    std::vector<Frame> all;
    motion.place_links(from + t * step, all);
    return all;
  }
};

// Straight products of matrices, from the stock up to the root and down to the link.
Eigen::Matrix4d pose_by_matrices(const Sample& sample, int link, const Configuration& q) {
  const Robot& robot = sample.cell.robot;
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
  while (robot.links[static_cast<std::size_t>(link)].parent_joint >= 0) {
    const int index = robot.links[static_cast<std::size_t>(link)].parent_joint;
    const Joint& joint = robot.joints[static_cast<std::size_t>(index)];
    const auto value_of = [&](int which) {
      return q[std::find(sample.joints.begin(), sample.joints.end(), which) - sample.joints.begin()];
    };
    double value = 0;
    if (joint.kind != JointKind::fixed)
      value = joint.mimic < 0 ? value_of(index) : joint.mimic_multiplier * value_of(joint.mimic) + joint.mimic_offset;
    Eigen::Matrix4d turn = Eigen::Matrix4d::Identity();
    if (joint.kind == JointKind::revolute) {  // Rodrigues
      Eigen::Matrix3d cross;
      cross << 0, -joint.axis.z(), joint.axis.y(), joint.axis.z(), 0, -joint.axis.x(), -joint.axis.y(), joint.axis.x(),
          0;
      turn.topLeftCorner<3, 3>() += std::sin(value) * cross + (1 - std::cos(value)) * cross * cross;
    }
    if (joint.kind == JointKind::prismatic) turn.topRightCorner<3, 1>() = value * joint.axis;
    pose = joint.origin.matrix() * turn * pose;
    link = joint.parent_link;
  }
  return pose;
}

TEST(LinkMotion, AgreesWithPlainMatrixProducts) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Sample sample(seed);
    const std::vector<Frame> poses = sample.poses(0);
    const Eigen::Matrix4d stock = pose_by_matrices(sample, sample.stock, sample.from).inverse();
    for (int link = 0; link < 10; ++link) {
      Eigen::Matrix4d expected = stock * pose_by_matrices(sample, link, sample.from);
      expected.topRightCorner<3, 1>() *= 1000;
      EXPECT_LT((poses[static_cast<std::size_t>(link)].matrix() - expected).norm(), 1e-9);
    }
  }
}

// The chain of core/cell is written separately: the two must agree where both apply.
TEST(LinkMotion, AgreesWithTheChainThatPlannersUse) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Sample sample(seed);
    const int tool = static_cast<int>((static_cast<std::uint64_t>(sample.stock) + 1 + seed % 9) % 10);
    if (sample.motion.joints_between(sample.stock, tool).empty()) continue;
    const Chain chain(sample.cell.robot, sample.stock, tool, 0.1, sample.cell.rest);
    const LinkMotion motion(sample.cell.robot, chain.joints(), sample.cell.rest, sample.stock);
    const Configuration q = sample.from.head(chain.dof());
    std::vector<Frame> expected, poses;
    chain.link_poses(q, expected);
    motion.place_links(q, poses);
    for (std::size_t link = 0; link < poses.size(); ++link) {
      EXPECT_LT((poses[link].linear() - expected[link].linear()).norm(), 1e-12);
      EXPECT_LT((poses[link].translation() - 1000 * expected[link].translation()).norm(), 1e-9);
    }
  }
}

TEST(MotionLimit, IsNeverExceededAndNotIdle) {
  double tightest = 1e9;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Sample sample(seed);
    const std::vector<Frame> middle = sample.poses(0.5);
    const Vec3 local =
        200 * Vec3(sample.random.between(-1, 1), sample.random.between(-1, 1), sample.random.between(-1, 1));
    const double radius = sample.random.between(0, 100);
    const Vec3 surface = radius * Vec3(sample.random.between(-1, 1), sample.random.between(-1, 1), 0.1).normalized();
    for (int base = 0; base < 10; ++base)
      for (int link = 0; link < 10; ++link) {
        const auto joints = sample.motion.joints_between(base, link);
        const auto b = static_cast<std::size_t>(base), l = static_cast<std::size_t>(link);
        const double limit = motion_limit(joints, middle, 0.5 * sample.step.cwiseAbs(), middle[l] * local, radius);
        const Vec3 before = middle[b].inverse() * middle[l] * (local + surface);
        double most = 0;
        for (int s = 0; s <= 20; ++s) {
          const std::vector<Frame> poses = sample.poses(s / 20.0);
          most = std::max(most, (poses[b].inverse() * poses[l] * (local + surface) - before).norm());
        }
        EXPECT_LE(most, limit + 1e-9);
        if (most > 1) tightest = std::min(tightest, limit / most);
      }
  }
  EXPECT_LT(tightest, 1.2);
}

TEST(LinkChain, PlacesALinkAsTheTreeDoes) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Sample sample(seed);
    const std::vector<Frame> poses = sample.poses(0);
    for (int base = 0; base < 10; ++base)
      for (int link = 0; link < 10; ++link) {
        const LinkChain chain = sample.motion.chain(base, link);
        LinkChain::Place place;
        chain.place(sample.from, place);
        const Frame expected = poses[static_cast<std::size_t>(base)].inverse() * poses[static_cast<std::size_t>(link)];
        EXPECT_LT((place.link.matrix() - expected.matrix()).norm(), 1e-9);
        const auto joints = sample.motion.joints_between(base, link);
        EXPECT_EQ(chain.is_rigid(), joints.empty());
        if (chain.is_rigid()) {
          EXPECT_LT((chain.rigid().matrix() - expected.matrix()).norm(), 1e-9);
        }
        for (Eigen::Index at = 0; at < sample.from.size(); ++at) {
          Configuration step = Configuration::Zero(sample.from.size());
          step[at] = 1;
          EXPECT_EQ(chain.moved_by(step),
                    std::ranges::any_of(joints, [&](const MovingJoint& joint) { return joint.coordinate == at; }));
        }
      }
  }
}

// Sampled, all points of a segment; small motions and large ones.
TEST(LinkChain, NothingStraysFromTheStraightWayByMoreThanItsSagitta) {
  double tightest = 1e9;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Sample sample(seed);
    const double share = seed % 3 == 0 ? 1 : seed % 3 == 1 ? 0.2 : 0.02;
    const Configuration step = share * sample.step, to = sample.from + step;
    const auto number = [&] { return 200 * sample.random.between(-1, 1); };
    const Vec3 a(number(), number(), number()), b(number(), number(), number());
    for (int base = 0; base < 10; ++base)
      for (int link = 0; link < 10; ++link) {
        const LinkChain chain = sample.motion.chain(base, link);
        LinkChain::Place start, end, here;
        chain.place(sample.from, start);
        chain.place(to, end);
        const double limit = chain.sagitta(start, end, step, a, b);
        double most = 0;
        for (int s = 0; s <= 20; ++s) {
          chain.place(sample.from + s / 20.0 * step, here);
          for (const double along : {0.0, 0.3, 1.0}) {
            const Vec3 point = a + along * (b - a);
            const Vec3 straight = (1 - s / 20.0) * (start.link * point) + s / 20.0 * (end.link * point);
            most = std::max(most, (here.link * point - straight).norm());
          }
        }
        EXPECT_LE(most, limit + 1e-9) << base << " " << link;
        if (most > 1e-3) tightest = std::min(tightest, limit / most);
        const auto joints = sample.motion.joints_between(base, link);
        if (std::ranges::none_of(joints, [](const MovingJoint& joint) { return joint.turns; })) {
          EXPECT_LT(limit, 1e-9);
        }
      }
  }
  EXPECT_LT(tightest, 1.1);
}

}  // namespace
}  // namespace sculpt
