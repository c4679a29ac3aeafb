#include "core/cell/chain.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.hpp"
#include "tests/core/cell/sample_robots.hpp"

namespace sculpt {
namespace {

/// One row of a modified Denavit-Hartenberg table (Craig), as the 4 x 4 matrix it stands for.
Eigen::Matrix4d modified_dh(double a, double d, double alpha, double theta) {
  const double ct = std::cos(theta), st = std::sin(theta), ca = std::cos(alpha), sa = std::sin(alpha);
  Eigen::Matrix4d m;
  m << ct, -st, 0, a,                  //
      st * ca, ct * ca, -sa, -d * sa,  //
      st * sa, ct * sa, ca, d * ca,    //
      0, 0, 0, 1;
  return m;
}

/// The published kinematics of the Panda, base to flange.
Eigen::Matrix4d panda_flange(const std::vector<double>& q) {
  const double h = std::acos(0.0);
  return modified_dh(0, 0.333, 0, q[0]) * modified_dh(0, 0, -h, q[1]) * modified_dh(0, 0.316, h, q[2]) *
         modified_dh(0.0825, 0, h, q[3]) * modified_dh(-0.0825, 0.384, -h, q[4]) * modified_dh(0, 0, h, q[5]) *
         modified_dh(0.088, 0, h, q[6]) * modified_dh(0, 0.107, 0, 0);
}

std::vector<SampleChain> all_chains() {
  return {shipped_chain(shipped_cell("panda-turntable")), shipped_chain(shipped_cell("gantry")), arm_on_rail(),
          mimic_machine()};
}

TEST(Chain, PandaOnTurntableFollowsThePublishedDenavitHartenbergTable) {
  const Cell cell = shipped_cell("panda-turntable");
  const Chain chain = cell.chain();
  ASSERT_EQ(chain.names(),
            (std::vector<std::string>{"table", "joint1", "joint2", "joint3", "joint4", "joint5", "joint6", "joint7"}));
  const double spindle_m = 0.07;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Configuration q = random_configuration(chain, random);
    const Eigen::Matrix4d flange = panda_flange(std::vector<double>(q.data() + 1, q.data() + 8));
    const Eigen::Vector4d ball = flange * Eigen::Vector4d(0, 0, spindle_m + cell.tool.stickout_m, 1);

    // From the room into the table's frame, written out.
    const double c = std::cos(q[0]), s = std::sin(q[0]);
    const auto turned_back = [&](double x, double y, double z) { return Vec3(c * x + s * y, c * y - s * x, z); };
    const Vec3 expected = turned_back(ball.x() - 0.55, ball.y(), ball.z() - 0.1);
    const Vec3 axis = turned_back(-flange(0, 2), -flange(1, 2), -flange(2, 2));

    const ToolPose pose = chain.tool_pose(q);
    EXPECT_LT((pose.ball_m - expected).norm(), 1e-12);
    EXPECT_LT((pose.axis - axis).norm(), 1e-12);
  }
}

TEST(Chain, JacobianAgreesWithFiniteDifferencesOfThePose) {
  for (const SampleChain& sample : all_chains()) {
    SCOPED_TRACE(sample.title);
    const Chain chain = sample.chain();
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      SCOPED_TRACE(seed);
      Random random(seed);
      const Configuration q = random_configuration(chain, random);
      const auto jacobian = chain.jacobian(q);
      ASSERT_EQ(jacobian.cols(), chain.dof());
      for (int c = 0; c < chain.dof(); ++c) {
        const double step = 1e-6;
        Configuration after = q, before = q;
        after[c] += step;
        before[c] -= step;
        const ToolPose a = chain.tool_pose(after), b = chain.tool_pose(before);
        const Vec3 speed = (a.ball_m - b.ball_m) / (2 * step), axis_speed = (a.axis - b.axis) / (2 * step);
        const Vec3 turn = jacobian.col(c).tail<3>();
        EXPECT_LT((jacobian.col(c).head<3>() - speed).norm(), 1e-8);
        EXPECT_LT((turn.cross(chain.tool_pose(q).axis) - axis_speed).norm(), 1e-8);
      }
    }
  }
}

TEST(Chain, ToolPoseIsThePoseOfTheToolLinkAmongAllLinks) {
  for (const SampleChain& sample : all_chains()) {
    SCOPED_TRACE(sample.title);
    const Chain chain = sample.chain();
    std::vector<Frame> poses;
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      SCOPED_TRACE(seed);
      Random random(seed);
      const Configuration q = random_configuration(chain, random);
      chain.link_poses(q, poses);
      ASSERT_EQ(poses.size(), sample.robot.links.size());
      const Frame& tool = poses[static_cast<std::size_t>(chain.tool_link())];
      const ToolPose pose = chain.tool_pose(q);
      EXPECT_LT((pose.ball_m - tool * Vec3(0, 0, chain.stickout_m())).norm(), 1e-12);
      EXPECT_LT((pose.axis + tool.linear().col(2)).norm(), 1e-12);
      EXPECT_TRUE(poses[static_cast<std::size_t>(chain.stock_link())].isApprox(Frame::Identity(), 0));
    }
  }
}

TEST(Chain, JointOnTheStockSideMovesTheToolTheOtherWay) {
  const Robot robot = parse_plain(R"(<robot name="lathe"><link name="bed"/><link name="table"/><link name="head"/>
    <joint name="table" type="prismatic"><parent link="bed"/><child link="table"/><axis xyz="1 0 0"/>
      <limit lower="-1" upper="1" velocity="1" effort="1"/></joint>
    <joint name="head" type="prismatic"><parent link="bed"/><child link="head"/><axis xyz="1 0 0"/>
      <limit lower="-1" upper="1" velocity="1" effort="1"/></joint></robot>)");
  const Chain chain(robot, robot.find_link("table"), robot.find_link("head"), 0, {0, 0});
  EXPECT_EQ(chain.names(), (std::vector<std::string>{"table", "head"}));
  EXPECT_NEAR(chain.tool_pose(Eigen::Vector2d(0.25, 0)).ball_m.x(), -0.25, 1e-15);
  EXPECT_NEAR(chain.tool_pose(Eigen::Vector2d(0, 0.25)).ball_m.x(), 0.25, 1e-15);
  EXPECT_TRUE(chain.translating());

  const Chain back(robot, robot.find_link("head"), robot.find_link("table"), 0, {0, 0});
  EXPECT_EQ(back.names(), (std::vector<std::string>{"head", "table"}));
}

TEST(Chain, MimicJointsFollowTheirSourceAndAreNoCoordinates) {
  const SampleChain sample = mimic_machine();
  const Chain chain = sample.chain();
  EXPECT_EQ(chain.names(), (std::vector<std::string>{"turn", "tilt", "slide"}));
  EXPECT_FALSE(chain.translating());
  const std::vector<double> values = chain.joint_values(Eigen::Vector3d(0.4, -0.3, 0.1));
  const auto value = [&](const char* joint) {
    return values[static_cast<std::size_t>(sample.robot.find_joint(joint))];
  };
  EXPECT_DOUBLE_EQ(value("turn"), 0.4);
  EXPECT_DOUBLE_EQ(value("tilt"), -0.3);
  EXPECT_DOUBLE_EQ(value("slide"), 0.1);
  EXPECT_DOUBLE_EQ(value("telescope"), 1.5 * 0.1 + 0.02);
  EXPECT_DOUBLE_EQ(value("nod"), -2 * (1.5 * 0.1 + 0.02) + 0.3);
  EXPECT_DOUBLE_EQ(value("flap"), 0.5) << "a joint off the path stands at its rest";
}

TEST(Chain, SourceOffThePathIsACoordinateWhenItsFollowerIsOnIt) {
  const Robot robot = parse_plain(R"(<robot name="twin"><link name="bed"/><link name="left"/><link name="right"/>
    <joint name="a" type="prismatic"><parent link="bed"/><child link="left"/><axis xyz="0 0 1"/>
      <limit lower="0" upper="1" velocity="1" effort="1"/></joint>
    <joint name="b" type="prismatic"><parent link="bed"/><child link="right"/><axis xyz="0 0 1"/>
      <limit lower="-1" upper="0" velocity="1" effort="1"/><mimic joint="a" multiplier="-2"/></joint></robot>)");
  const Chain chain(robot, robot.find_link("bed"), robot.find_link("right"), 0, {0, 0});
  EXPECT_EQ(chain.names(), std::vector<std::string>{"a"});
  EXPECT_NEAR(chain.tool_pose(Configuration::Constant(1, 0.25)).ball_m.z(), -0.5, 1e-15);
  EXPECT_DOUBLE_EQ(chain.upper()[0], 0.5) << "the follower's range ends first";
}

TEST(Chain, TurnRatesBoundHowFastTheAxisTurns) {
  for (const SampleChain& sample : all_chains()) {
    SCOPED_TRACE(sample.title);
    const Chain chain = sample.chain();
    const Configuration turns = chain.turn_rates();
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      SCOPED_TRACE(seed);
      Random random(seed);
      const Configuration q = random_configuration(chain, random, 0.1);
      Configuration rate(chain.dof());
      for (Eigen::Index c = 0; c < rate.size(); ++c) rate[c] = random.between(-1, 1);
      const Vec3 axis = chain.tool_pose(q).axis, turned = chain.tool_pose(q + 1e-6 * rate).axis;
      EXPECT_LE((turned - axis).norm() / 1e-6, turns.dot(rate.cwiseAbs()) + 1e-6);
    }
  }
}

TEST(Chain, LimitsIncludeTheirEndsAndTheSlack) {
  const Cell cell = shipped_cell("gantry");
  const Chain chain = cell.chain();
  EXPECT_TRUE(chain.within_limits(chain.lower()));
  EXPECT_TRUE(chain.within_limits(chain.upper()));
  const Configuration outside = chain.upper() + Configuration::Constant(3, 1e-6);
  EXPECT_FALSE(chain.within_limits(outside));
  EXPECT_TRUE(chain.within_limits(outside, 2e-6));
}

TEST(Chain, WithoutAMovableJointIsRefused) {
  const Robot robot = parse_plain(R"(<robot name="stiff"><link name="a"/><link name="b"/>
    <joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint></robot>)");
  try {
    Chain(robot, 0, 1, 0, {0});
    FAIL() << "a chain without joints was accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), "chain_empty");
    EXPECT_NE(std::string(error.what()).find("'a'"), std::string::npos);
  }
}

TEST(Chain, OfTooManyJointsIsRefused) {
  std::string xml = R"(<robot name="snake"><link name="l0"/>)";
  for (int joint = 0; joint <= max_joints; ++joint)
    xml += "<link name=\"l" + std::to_string(joint + 1) + "\"/><joint name=\"j" + std::to_string(joint) +
           "\" type=\"revolute\"><parent link=\"l" + std::to_string(joint) + "\"/><child link=\"l" +
           std::to_string(joint + 1) +
           "\"/><axis xyz=\"0 0 1\"/><limit lower=\"-1\" upper=\"1\" velocity=\"1\" effort=\"1\"/></joint>";
  const Robot robot = parse_plain(xml + "</robot>");
  const auto chain_to = [&](int link) {
    return Chain(robot, robot.find_link("l0"), robot.find_link("l" + std::to_string(link)), 0,
                 std::vector<double>(robot.joints.size(), 0.0));
  };
  EXPECT_EQ(chain_to(max_joints).dof(), max_joints);
  try {
    chain_to(max_joints + 1);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), "urdf_invalid");
  }
}

}  // namespace
}  // namespace sculpt
